// lorentz first-hit: reads queries and writes answers, line by line or in columns (first_hit_columns.cpp).
#include <deque>

#include <lorentz/exchange.hpp>
#include "cli/app.hpp"
#include "cli/first_hit.hpp"
#include "cli/help_texts.hpp"
#include "cli/numbers.hpp"
#include "cli/output.hpp"
#include "cli/query_stream.hpp"
#include "cli/terminal.hpp"
#include "question/answerer.hpp"
#include "question/engines.hpp"
#include "report/files/scene_file.hpp"
#include "src/exchange/nearest_name.hpp"

namespace lorentz::cli {

using namespace question;

namespace {

struct FirstHitOptions {
  std::string queries = "-", engine = "oracle", format = "ndjson";
  std::optional<std::string> scene, x, v;
  std::optional<double> radius, max_time, timeout;
  std::optional<std::uint64_t> digits, jobs;
  bool detail = false, strict = false, prove = false, records = false;
};

// Puts the answers in the order of the lines, although answers to bad lines are known at once and answers to
// queries arrive later.
class AnswerOrder {
 public:
  explicit AnswerOrder(std::string& out) : out_(out) {}

  /// A finite `limit` is applied to the answer: that of an engine which knows no limits.
  void expect(const Id& id, const Components& components, double limit) {
    waiting_.push_back({id, components, limit, {}});
  }
  void answered(Answer& answer) {
    const WaitingLine& line = waiting_.front();
    append_answer_line(out_, line.id, limited(std::move(answer), line.limit), line.components);
    waiting_.pop_front();
    put_bad_lines();
  }
  void bad_line(const Id& id, const std::string& message) {
    waiting_.push_back({id, 0, kForEver, message});
    put_bad_lines();
  }
  std::size_t waiting() const { return waiting_.size(); }

 private:
  struct WaitingLine {
    Id id;
    Components components;
    double limit;
    std::optional<std::string> message;  // of a bad line
  };

  // Those whose turn it is.
  void put_bad_lines() {
    for (; !waiting_.empty() && waiting_.front().message; waiting_.pop_front())
      append_answer_line(out_, waiting_.front().id, Answer::error(*waiting_.front().message), 0);
  }

  std::string& out_;
  std::deque<WaitingLine> waiting_;
};

constexpr std::size_t kMaxWaiting = 100'000;  // lines: bounds the bad lines behind a query

oracle::Request request_of(const FirstHitOptions& options, const EngineInfo& engine) {
  if (options.digits && !engine.traits.knows_digits)
    throw InputError("--digits: only the oracle knows more digits than a binary64 has");
  return {.digits = static_cast<int>(options.digits.value_or(0)),
          .detail = options.detail,
          .max_time = options.max_time};
}

int jobs_of(const FirstHitOptions& options, const EngineInfo& engine) {
  if (!options.jobs) return 1;
  const auto jobs = static_cast<int>(*options.jobs);
  if (engine.traits.together == 0 && engine.kind != EngineInfo::Kind::library)
    throw InputError(
        "--jobs: only the engines batch, certified-batch and gpu, and libraries, use more than one thread");
  return jobs;
}

int act_on_columns(const FirstHitOptions& options, ColumnOrder::Format format) {
  const EngineInfo engine = engine_named(options.engine, options.timeout);
  const std::string option = "--format " + options.format;
  if (!engine.is_own())
    throw InputError(option + ": not with cmd: engines and libraries; leave --format out");
  if (!options.scene) throw InputError(option + ": needs --scene, for columns hold no scene");
  if (options.digits || options.detail || options.prove)
    throw InputError((options.digits   ? "--digits"
                      : options.detail ? "--detail"
                                       : "--prove") +
                     std::string(": only streams in JSON have it (--format ndjson)"));
  ColumnOrder order{.format = format, .queries = queries_file(options.queries), .engine = engine};
  order.max_time = options.max_time;
  order.jobs = jobs_of(options, engine);
  order.strict = options.strict;
  order.scene = load_scene(*options.scene, options.radius, order.strict);
  return answer_columns(order);
}

int act_on_lines(const FirstHitOptions& options) {
  const EngineInfo engine = engine_named(options.engine, options.timeout);
  AnswererOptions answerer_options{request_of(options, engine)};
  answerer_options.listener = terminal();
  answerer_options.strict = options.strict;
  answerer_options.applies_limits = true;
  answerer_options.jobs = jobs_of(options, engine);
  answerer_options.timeout = options.timeout.value_or(answerer_options.timeout);
  const std::unique_ptr<Answerer> answerer = engine.answerer(answerer_options);
  if (options.radius && !options.scene)
    throw InputError("--radius: needs --scene (the scenes of a stream say their radii themselves)");
  std::optional<Scene> initial;
  if (options.scene) {
    initial = load_scene(*options.scene, options.radius, options.strict);
    answerer->set_scene(*initial);
  }
  if (options.records) {
    GivenQueries queries(options.queries, initial, options.strict);
    return write_records(queries, (options.scene ? " --scene " + shell_quoted(*options.scene) : "") +
                                      (options.radius ? fmt::format(" --radius {} ", *options.radius) : " ") +
                                      shell_quoted(options.queries));
  }
  const auto one = one_query(options.x, options.v, initial.has_value(), options.queries);
  QueryStream stream = one ? QueryStream(*one, "--x and --v", initial, options.strict)
                           : QueryStream(options.queries, initial, options.strict);
  if (options.prove) return answer_with_proofs(stream, *answerer);
  Output output;
  AnswerOrder order(output.buffer());
  answerer->on_reply([&](question::Reply& reply) { order.answered(reply.answer); });
  // While the input pauses, answers continue to arrive.
  stream.lines().before_waiting([&] {
    do output.flush();
    while (answerer->idle(stream.lines().descriptor()));
    output.flush();
  });
  for (StreamItem item; stream.next(item); output.flush_if_due()) {
    switch (item.kind) {
      case StreamItem::Kind::scene:
        answerer->set_scene(item.scene);
        break;
      case StreamItem::Kind::query:
        order.expect(item.id, *stream.scene(),
                     answerer->takes_limits() ? kForEver
                                              : std::min(item.max_time, options.max_time.value_or(kForEver)));
        answerer->ask_until(item.id, item.query, item.max_time);
        break;
      default:
        order.bad_line(item.id, item.message);
        if (order.waiting() >= kMaxWaiting) answerer->drain();
    }
  }
  answerer->finish();
  output.flush();
  if (answerer->failed()) return kFailed;
  return stream.had_bad_input() ? kBadInput : kDone;
}

void check_proving(const FirstHitOptions& options) {
  if (options.records && !options.prove) throw InputError("--records: needs --prove");
  if (options.records && options.engine != "oracle")
    throw InputError("--records: holds exact answers; leave --engine out");
  if (options.prove && (options.digits || options.detail || options.max_time))
    throw InputError(std::string(options.digits   ? "--digits"
                                 : options.detail ? "--detail"
                                                  : "--max-time") +
                     ": not with --prove, which proves the whole answer, with 40 digits");
}

int run_first_hit(const FirstHitOptions& options) {
  check_proving(options);
  if ((options.x || options.v) && (options.format != "ndjson" || options.records))
    throw InputError("--x and --v: ask one query, without columns or records; leave " +
                     std::string(options.records ? "--records" : "--format") + " out");
  const std::size_t format = index_of_name(options.format, {"ndjson", "csv", "npy"}, "--format");
  using Format = ColumnOrder::Format;
  return format == 0 ? act_on_lines(options)
                     : act_on_columns(options, format == 1 ? Format::csv : Format::npy);
}

}  // namespace

Command first_hit_command() {
  auto options = std::make_shared<FirstHitOptions>();
  return {
      "first-hit",
      "Which obstacle is hit first? Queries to answers, line by line.",
      {
          {"queries", &options->queries, "FILE", "queries; - is standard input"},
          {"-e,--engine", &options->engine, "ENGINE", kEngineHelp},
          {"--scene", &options->scene, "SCENE",
           "scene before the first scene line: a file, or a name of the catalogue"},
          {"--radius", Positive{&options->radius}, "R", "radius of every ball of --scene"},
          {"--x", &options->x, "X1,X2,..", "ask one query of --scene, without a stream: the position"},
          {"--v", &options->v, "V1,V2,..", "its velocity"},
          {"--digits", Whole{&options->digits, 1, kMostDigits}, "N",
           "also print the time with N significant decimal digits (oracle)"},
          {"--max-time", Positive{&options->max_time}, "T",
           "answer `later` if nothing is entered before time T (of a query alone: its key max_time)"},
          {"--detail", &options->detail, "",
           "add the collision point, the outward normal and the impact parameter"},
          {"--prove", &options->prove, "",
           "add to each answer that is exactly right 40 digits of its time, and a proof that any of the "
           "checkers goes through (docs/certificates.md); status 1 if one is not"},
          {"--records", &options->records, "", "with --prove: write a golden set (docs/formats.md)"},
          {"--format", &options->format, "ndjson|csv|npy",
           "of queries and answers: ndjson (a stream), or columns of numbers: csv, npy (NumPy; "
           "docs/formats.md), which need --scene"},
          {"--jobs", Whole{&options->jobs, 1, 1024}, "N",
           "threads, of batch, certified-batch, gpu and a library: the same answers"},
          {"--strict", &options->strict, "", kStrictKeysHelp},
          {"--timeout", Positive{&options->timeout}, "SECONDS", kTimeoutHelp},
      },

      "Examples:\n"
      "  lorentz first-hit --scene square --radius 0.1 --x 0,0.445 --v 1,0.0175\n"
      R"(  echo '{"id":1,"x":[0,0.445],"v":[1,0.0175]}' | lorentz first-hit --scene square )"
      "--radius 0.1\n  printf 'x1,x2,v1,v2\\n0,0.445,1,0.0175\\n' | lorentz first-hit --scene square "
      "--format csv\n  lorentz first-hit --scene square --format npy --engine batch --jobs 2 queries.npy > "
      "answers.npy\n"
      "  lorentz sample --scene square --radius 0.1 --count 3 | lorentz first-hit --prove --records | "
      "lorentz golden verify -",
      [options] { return run_first_hit(*options); }};
}

}  // namespace lorentz::cli
