// Judges a Python function with the same code as any engine: for the judge, the function is an engine with a
// name.
#include <atomic>
#include <exception>
#include <mutex>

#include "judge/judge_report.hpp"
#include "python/lines.hpp"
#include "python/scene.hpp"
#include "python/signals.hpp"
#include "report/files/whole_file.hpp"
#include "report/page.hpp"

namespace lorentz::python {
namespace {

// A run of the judge. Ctrl-C in Python ends it, and so does an exception that does not come from the engine.
struct JudgeRun {
  std::atomic<bool> stop = false;

  void fail(std::exception_ptr failure) {
    const std::lock_guard lock(mutex);
    if (!first) first = std::move(failure);
    stop = true;
  }
  void rethrow() const {
    if (first) std::rethrow_exception(first);
  }

 private:
  std::mutex mutex;
  std::exception_ptr first;
};

constexpr std::size_t kGathered = 8192;

// Collects queries of one scene, and calls `ask(scene, x, v, start_from)`, which returns one answer per
// query, as lines of JSON. The interpreter's lock is held only during these calls.
class FunctionAnswerer final : public question::Answerer {
 public:
  FunctionAnswerer(const py::function& ask, JudgeRun& run) : ask_(&ask), run_(run) {}
  ~FunctionAnswerer() override {
    const py::gil_scoped_acquire gil;
    scene_ = py::object();
  }

  void ask(const Id&, const Query& query) override {
    queries_.push_back(query);
    if (queries_.size() == kGathered) drain();
  }
  void drain() override {
    if (queries_.empty()) return;
    std::vector<Answer> answers = run_.stop ? std::vector<Answer>() : answered();
    const std::size_t asked = answers.size();
    answers.resize(queries_.size(), Answer::error("not asked"));
    queries_.clear();
    for (std::size_t i = 0; i < answers.size(); ++i)
      deliver({std::move(answers[i]), i < asked ? question::Origin::engine : question::Origin::not_asked});
  }

 private:
  void enter(const Scene& scene) override {
    drain();
    dimension_ = scene.dimension, components_ = scene;
    const py::gil_scoped_acquire gil;
    scene_ = py::cast(PyScene(scene));
  }
  std::vector<Answer> answered() {
    std::vector<Answer> answers;
    const py::gil_scoped_acquire gil;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      const auto texts =
          (*ask_)(scene_, vectors(&Query::x), vectors(&Query::v), starts()).cast<std::vector<std::string>>();
      for (const std::string& text : texts) answers.push_back(answer_of(text));
    } catch (const py::error_already_set&) {
      run_.fail(std::current_exception());
    } catch (const py::cast_error&) {
      run_.fail(std::current_exception());
    }
    return answers;
  }

  // An invalid answer counts as an error of the engine.
  Answer answer_of(const std::string& text) const {
    try {
      return read_answer(text, components_);
    } catch (const InputError& error) {
      return Answer::error(std::string("no answer: ") + error.what());
    }
  }

  py::array_t<double> vectors(Vec Query::*member) const {
    py::array_t<double> array({static_cast<py::ssize_t>(queries_.size()), py::ssize_t{dimension_}});
    auto numbers = array.mutable_unchecked<2>();
    for (py::ssize_t i = 0; i < numbers.shape(0); ++i)
      for (py::ssize_t k = 0; k < dimension_; ++k)
        numbers(i, k) = (queries_[static_cast<std::size_t>(i)].*member)[static_cast<std::size_t>(k)];
    return array;
  }

  // For each query the obstacle that it leaves, or None.
  py::list starts() const {
    py::list list;
    for (const Query& query : queries_)
      list.append(query.from ? py::object(to_python(*query.from, components_)) : py::none());
    return list;
  }

  const py::function* ask_;  // outlives this
  JudgeRun& run_;
  int dimension_ = 0;
  Components components_ = 0;
  py::object scene_;
  std::vector<Query> queries_;
};

// Runs without the interpreter's lock, so that a function's answerers can take it in any thread.
lorentz::judge::JudgeReport report_of(const lorentz::judge::JudgeOrder& order, JudgeRun& run) {
  lorentz::judge::JudgeReport report;
  {
    const py::gil_scoped_release release;
    report = watched(run.stop, [&] { return lorentz::judge::judged(order, run.stop); });
  }
  run.rethrow();
  return report;
}

py::tuple judge_function(const py::object& function, const std::string& engine, const std::string& command,
                         bool quick, std::optional<double> time, std::optional<std::size_t> questions,
                         std::uint64_t seed, unsigned jobs, double ulps, bool times,
                         const std::optional<std::string>& html, const std::string& claim) {
  lorentz::judge::JudgeOrder order;
  order.command = command, order.quick = quick, order.time = time, order.questions = questions;
  order.seed = seed, order.jobs = jobs, order.ulps = ulps, order.times = times, order.claim = claim_of(claim);
  if (jobs < 1 || jobs > 1024) throw InputError("jobs: needs a number from 1 to 1024");
  if (time && !(*time > 0 && *time < 1e9)) throw InputError("time: needs seconds above 0");
  if (!(ulps >= 0 && ulps < 1e300)) throw InputError("ulps: needs a number, 0 or above");
  if (time && questions) throw InputError("questions: not together with time");
  if (html) report::page("{}");  // throws without a page: now rather than after two minutes
  JudgeRun run;
  py::function ask;
  if (function.is_none()) {
    order.engine = question::engine_named(engine);
  } else {
    ask = function.cast<py::function>();
    order.engine = question::guest_engine(engine, [&](const question::AnswererOptions&) {
      return std::make_unique<FunctionAnswerer>(ask, run);
    });
  }
  const lorentz::judge::JudgeReport report = report_of(order, run);
  if (html) write_whole(*html, report::page(report.json()));
  return py::make_tuple(report.json(), report.text(true));
}

}  // namespace

void bind_judge(py::module_& module) {
  module.def("judge", judge_function, py::arg("function"), py::arg("engine"), py::arg("command"),
             py::arg("quick"), py::arg("time"), py::arg("questions"), py::arg("seed"), py::arg("jobs"),
             py::arg("ulps"), py::arg("times"), py::arg("html"), py::arg("claim"));
  module.attr("HAS_PAGE") = report::has_page();
}

}  // namespace lorentz::python
