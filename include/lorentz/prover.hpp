// Writes certificates: proofs that an exact answer is right, for those who do not believe the oracle.
#pragma once

#include <lorentz/answer.hpp>
#include <lorentz/certificate.hpp>
#include <lorentz/pimpl.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>

namespace lorentz::oracle {

/// Certificates for the answers of one scene.
///
///  1. What it writes of an exact answer is accepted by CertificateCheck and by data/check.py, if it takes no
///     more than kMostSteps; of a wrong answer, refuted.
///     held by "Prover: the proofs of drawn answers are accepted",
///             "Prover: whatever it writes of a wrong answer is refuted"
///
/// Cost: that of the oracle. Allocates. Any number of threads may ask one prover.
class Prover {
 public:
  /// Throws InputError for a scene with a flaw (flaw_of) or dependent vectors (dependence_in).
  explicit Prover(const Scene& scene);
  Prover(Prover&&) noexcept;
  Prover& operator=(Prover&&) noexcept;
  ~Prover();

  /// The certificate of an exact `hit`, `inside` or `never`; of an error an empty one. Of a wrong
  /// answer, whatever it says is refuted by who checks it. Few windows of few rows, however long the flight;
  /// but around obstacles of very many cells in radius, as many rows and obstacles as these cross: beyond
  /// kMostSteps, which CertificateCheck counts, no checker accepts it.
  Certificate prove(const Query& query, const Answer& exact) const;

 private:
  struct Impl;
  Pimpl<const Impl> impl_;
};

}  // namespace lorentz::oracle
