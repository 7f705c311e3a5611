// A second opinion about certificates (docs/certificates.md): the checker examines a proof and does not know
// how answers are found. It shares no code with the oracle's searches, nor with their comparison and rounding
// of times.
#pragma once

#include <optional>
#include <string>

#include <lorentz/answer.hpp>
#include <lorentz/certificate.hpp>
#include <lorentz/pimpl.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>

namespace lorentz::oracle {

/// Checks proofs of answers to queries in one scene.
///
///  1. No false answer passes, whatever the certificate holds.
///  2. It accepts the same forms and proofs as data/check.py, a checker with plain integers in Python.
///
/// Cost: proportional to the rows and obstacles of the proof, a few million per second.
class CertificateCheck {
 public:
  /// Converts the scene to integers, once. If the scene is invalid or has dependent vectors, no proof is
  /// accepted. `most_steps` is the number of steps (docs/certificates.md) that a proof may take; the checker
  /// does a few million per second.
  explicit CertificateCheck(const Scene& scene, long most_steps = kMostSteps);
  CertificateCheck(CertificateCheck&&) noexcept;
  CertificateCheck& operator=(CertificateCheck&&) noexcept;
  ~CertificateCheck();

  /// Returns nothing if the certificate proves the answer. Otherwise says what is wrong, in one line that
  /// names the window, the atom or the obstacle. The proof is about outcome, obstacle, time and, if they are
  /// there, `time_decimal` and `exit_time`, but not about the collision's detail. No false answer passes,
  /// whatever the certificate holds. A proof beyond the limits of certificate.hpp is refused. If it takes too many steps,
  /// `*too_long` (if given) becomes true, whether or not the proof is right. Safe to call from several
  /// threads.
  std::optional<std::string> refutation(const Query& query, const Answer& answer,
                                        const Certificate& certificate, bool* too_long = nullptr) const;

 private:
  struct Impl;
  Pimpl<const Impl> impl_;
};

}  // namespace lorentz::oracle
