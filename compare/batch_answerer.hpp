// The batch engines as answerers: queries are gathered, and flown together.
#pragma once

#include <optional>
#include <vector>

#include <lorentz/certified_batch.hpp>
#include "compare/answerer.hpp"

namespace lorentz::compare {

class BatchAnswerer final : public Answerer {
 public:
  /// `certified`: the engine `certified-batch`, else `batch`.
  BatchAnswerer(bool certified, const AnswererOptions& options);

  void set_scene(const Scene& scene) override;
  void ask(const Id& id, const Query& query) override;
  void ask_text(const Id& id, const std::string& text) override;
  void drain() override;
  void finish() override { drain(); }
  bool idle(int) override;

 private:
  void fly();
  void answer_all();
  Answer answer_of_flight(std::size_t i);
  Answer single(const Query& query) const;

  const bool certified_;
  const oracle::Request request_;
  const int jobs_;
  Scene scene_;
  std::optional<std::string> why_not_;  ///< the scene is beyond the engine
  std::optional<Batch> batch_;
  std::optional<oracle::CertifiedBatch> certified_batch_;
  QueryTable queries_;
  FlightTable flights_;
  std::vector<std::size_t> uncertain_;
};

}  // namespace lorentz::compare
