// Writes certificates: proofs that an exact answer is right, for users who do not trust the oracle.
#pragma once

#include <lorentz/answer.hpp>
#include <lorentz/certificate.hpp>
#include <lorentz/pimpl.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>

namespace lorentz::oracle {

/// Certificates for the answers of one scene.
///
///  1. CertificateCheck and data/check.py accept the certificate of an exact answer, if it takes at most
///     kMostSteps steps. They refute the certificate of a wrong answer.
///
/// Cost: that of the oracle. Allocates. Any number of threads may use one prover.
class Prover {
 public:
  /// Throws InputError if the scene is invalid (flaw_of) or has dependent vectors (dependence_in).
  explicit Prover(const Scene& scene);
  Prover(Prover&&) noexcept;
  Prover& operator=(Prover&&) noexcept;
  ~Prover();

  /// The certificate of an exact `hit`, `inside` or `never`. If `exact` is wrong, it is unspecified and the
  /// checker rejects it. Throws InputError for an invalid query. A certificate has few windows of few rows,
  /// however long the flight. But around obstacles with radii of very many cells, it has as many rows and
  /// obstacles as these cross: beyond kMostSteps, which CertificateCheck counts, no checker accepts it.
  Certificate prove(const Query& query, const Answer& exact) const;

 private:
  struct Impl;
  Pimpl<const Impl> impl_;
};

}  // namespace lorentz::oracle
