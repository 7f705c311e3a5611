// The second opinion about certificates (docs/certificates.md): checks a proof and knows nothing of how
// answers are found. It shares no code with the oracle's searches, nor their comparison and rounding of
// times.
#pragma once

#include <optional>
#include <string>

#include <lorentz/answer.hpp>
#include <lorentz/certificate.hpp>
#include <lorentz/pimpl.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>

namespace lorentz::oracle {

/// Checks proofs of answers to the queries of one scene.
///
///  1. No false answer passes, whatever the certificate holds.
///     held by "Another obstacle than the first is refused, whatever the proof holds",
///             "No false answer passes with proofs tampered with at random"
///  2. The same forms and proofs are accepted as by data/check.py, a check of plain integers in Python.
///
/// Cost: proportional to the rows and obstacles of the proof, some millions a second.
class CertificateCheck {
 public:
  /// Puts the scene into integers, once. Of a scene with a flaw or with dependent vectors nothing is proved.
  /// `most_steps`: the steps (docs/certificates.md) that a proof may take, some millions a second.
  explicit CertificateCheck(const Scene& scene, long most_steps = kMostSteps);
  CertificateCheck(CertificateCheck&&) noexcept;
  CertificateCheck& operator=(CertificateCheck&&) noexcept;
  ~CertificateCheck();

  /// Nothing if the certificate proves the answer; else what is wrong, in one line that names the window, the
  /// atom or the obstacle. Of the answer that is outcome, obstacle, time and, if there are digits,
  /// time_decimal; the collision's detail is no part of it. Whatever the certificate holds, no false answer
  /// passes. A proof beyond the limits of certificate.hpp is refused; if it takes too many steps, whether it
  /// is right or not, `too_long` becomes true, if it is given. Safe to call from several threads.
  std::optional<std::string> refutation(const Query& query, const Answer& answer,
                                        const Certificate& certificate, bool* too_long = nullptr) const;

 private:
  struct Impl;
  Pimpl<const Impl> impl_;
};

}  // namespace lorentz::oracle
