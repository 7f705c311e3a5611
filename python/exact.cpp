// The oracle and everything that judges by it, one question at a time.
#include <lorentz/certificate_check.hpp>
#include <lorentz/continued_fraction.hpp>
#include <lorentz/prover.hpp>
#include "judge/diagnosis.hpp"
#include "python/certificates.hpp"
#include "python/lines.hpp"
#include "python/scene.hpp"
#include "question/counts.hpp"

namespace lorentz::python {
namespace {

using oracle::DecisionKind;

const char* decision_name(DecisionKind kind) {
  constexpr const char* kNames[] = {"containing", "meeting", "order"};
  static_assert(std::size(kNames) == static_cast<std::size_t>(DecisionKind::order) + 1);
  return kNames[static_cast<int>(kind)];
}

// A scene with its oracle, judge and other exact tools. Each is created when it is first needed, under the
// interpreter's lock.
class PyOracle {
 public:
  explicit PyOracle(const PyScene& scene)
      : place_(std::make_shared<question::Place>(scene.scene())), scene_(place_->scene()) {}

  std::string first_hit(const std::string& query, int digits, bool detail,
                        std::optional<double> max_time) const {
    return answer_text(place_->oracle().first_hit(read_query(query, scene_), {digits, detail, max_time}),
                       scene_);
  }

  bool is_free(const std::string& query) const {
    return place_->oracle().is_free(read_query(query, scene_).x);
  }

  py::dict margin(const std::string& text) const {
    const auto [query, exact] = question(text);
    py::dict dict;
    dict["condition"] = py::none();
    dict["margin"] = py::none();
    if (exact.outcome == Outcome::hit) dict["condition"] = place_->margins().condition(query, exact);
    const auto hardest = place_->margins().hardest_decision(query, exact);
    if (!hardest) return dict;
    dict["margin"] = hardest->margin;
    if (hardest->margin >= oracle::kLargestMargin) return dict;
    dict["decision"] = decision_name(hardest->kind);
    dict["decided"] = hardest->yes;
    dict["obstacle"] = to_python(hardest->obstacle, scene_);
    return dict;
  }

  py::list passed(const std::string& text, std::size_t most) const {
    const auto [query, exact] = question(text);
    py::list list;
    if (exact.outcome != Outcome::hit) return list;
    for (const oracle::PassedObstacle& p : place_->margins().passed(query, exact, most))
      list.append(py::dict(py::arg("obstacle") = to_python(p.obstacle, scene_), py::arg("time") = p.time,
                           py::arg("gap") = p.gap, py::arg("margin") = p.margin));
    return list;
  }

  py::dict judge(const std::string& text, const std::string& given_text, double ulps,
                 const std::string& claim_line) const {
    const Claim claim = claim_of(claim_line);
    auto [query, exact] = question(text);
    const Answer given = read_answer(given_text, scene_);
    const question::Place place(scene_, claim);
    if (exact.outcome == Outcome::inside) exact = place.exact(query);
    const oracle::Judge& judge = claim == Claim() ? place_->judge() : place.judge();
    const oracle::Judgement judgement = judge.judge(query, exact, given, ulps);
    const auto diagnosis = lorentz::judge::diagnosis_of({place_, query, exact, {}, {}}, given, judgement);
    py::dict dict;
    dict["verdict"] = question::name_of(static_cast<question::Count>(judgement.verdict)).words;
    dict["wrong_time"] = judgement.wrong_time;
    dict["other_quantity"] = judgement.other_quantity;
    dict["ulps"] = judgement.ulps;
    dict["departs"] = judgement.departs;
    dict["cause"] = py::none();
    dict["sentence"] = py::none();
    if (!diagnosis) return dict;
    dict["cause"] = std::string(judge::name_of(diagnosis->cause));
    dict["sentence"] = judge::sentence_of(diagnosis->cause, diagnosis->by_radii);
    return dict;
  }

  PyCertificate prove(const std::string& text) const {
    const auto [query, exact] = question(text);
    if (!prover_) prover_.emplace(scene_);
    PyCertificate proved(prover_->prove(query, exact), scene_);
    bool too_long = false;
    const auto why = check().refutation(query, exact, proved.proof, &too_long);
    if (too_long) throw InputError("no checker goes through the proof: " + *why);
    return proved;
  }

  // `time_decimal` is a separate argument, because the reader of answers skips it.
  std::optional<std::string> refutation(const std::string& text, const std::string& answer_line,
                                        const std::string& time_decimal,
                                        const PyCertificate& certificate) const {
    Answer answer = read_answer(answer_line, scene_);
    answer.time_decimal = time_decimal;
    return check().refutation(read_query(text, scene_), answer, certificate.proof);
  }

 private:
  const oracle::CertificateCheck& check() const {
    if (!check_) check_.emplace(scene_);
    return *check_;
  }

  std::pair<Query, Answer> question(const std::string& text) const {
    Query query = read_query(text, scene_);
    Answer exact = place_->oracle().first_hit(query);
    return {std::move(query), std::move(exact)};
  }

  std::shared_ptr<question::Place> place_;
  const Scene& scene_;
  mutable std::optional<oracle::Prover> prover_;
  mutable std::optional<oracle::CertificateCheck> check_;
};

py::list convergents(double rise, double run, std::size_t limit) {
  if (run == 0) throw InputError("run: is 0, which gives no slope");
  const py::object fraction = py::module_::import("fractions").attr("Fraction");
  py::list list;
  for (const oracle::Convergent& c : oracle::convergents(rise, run, limit))
    list.append(py::make_tuple(to_python(c.a), to_python(c.p), to_python(c.q), fraction(c.remainder_exact)));
  return list;
}

}  // namespace

void bind_exact(py::module_& module) {
  py::class_<PyOracle>(module, "Oracle")
      .def(py::init<const PyScene&>(), py::arg("scene"))
      .def("first_hit", &PyOracle::first_hit, py::arg("query"), py::arg("digits"), py::arg("detail"),
           py::arg("max_time"))
      .def("is_free", &PyOracle::is_free, py::arg("query"))
      .def("margin", &PyOracle::margin, py::arg("query"))
      .def("passed", &PyOracle::passed, py::arg("query"), py::arg("most"))
      .def("judge", &PyOracle::judge, py::arg("query"), py::arg("answer"), py::arg("ulps"), py::arg("claim"))
      .def("prove", &PyOracle::prove, py::arg("query"))
      .def("refutation", &PyOracle::refutation, py::arg("query"), py::arg("answer"), py::arg("time_decimal"),
           py::arg("certificate"));
  module.def("convergents", convergents, py::arg("rise"), py::arg("run"), py::arg("limit"));
}

}  // namespace lorentz::python
