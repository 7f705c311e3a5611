// Drawn answers with their proofs, for the tests of the certificate check.
#pragma once

#include <catch2/catch.hpp>

#include <lorentz/certificate_check.hpp>
#include <lorentz/oracle.hpp>
#include "tests/oracle/certificate_prover.hpp"

namespace lorentz::test::proofs {

using oracle::Certificate;
using oracle::CertificateBasis;
using oracle::CertificateCheck;
using oracle::Window;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Case {
  Scene scene;
  Query query;
  Answer answer;
  Certificate proof;
};

inline Case proved(Scene scene, const Query& query, Answer answer, int pieces = 1) {
  Certificate proof = proof_of(scene, query, answer, pieces);
  return {std::move(scene), query, std::move(answer), std::move(proof)};
}

inline Case proved(const Scene& scene, const Query& query, int pieces = 1) {
  oracle::Request request;
  request.digits = 40;
  return proved(scene, query, oracle::Oracle(scene).first_hit(query, request), pieces);
}

inline std::string refutation(const Case& c) {
  return CertificateCheck(c.scene).refutation(c.query, c.answer, c.proof).value_or("");
}

inline std::string text(const Case& c) {
  return stream(c.scene, c.query) + line(c.answer, c.scene.dimension);
}

inline void require_accepted(const Case& c) {
  INFO(text(c));
  REQUIRE(refutation(c) == "");
}

/// Refused, for this reason.
inline void require_refused(const Case& c, const std::string& reason) {
  INFO(text(c));
  const std::string said = refutation(c);
  REQUIRE_THAT(said, Catch::Contains(reason));
  REQUIRE(said.find('\n') == std::string::npos);
}

inline Scene drawn_scene(Draw& draw, Style style) {
  const int dimension = draw.one_in(2) ? 2 : 3;
  Scene scene = scene_of(draw, style, dimension);
  return draw.one_in(3) ? with_ellipsoids(draw, style, scene) : scene;
}

inline Case drawn(Draw& draw) {
  const Style style = std::array{Style::generic, Style::grid, Style::near_grid}[draw.below(3)];
  const Scene scene = drawn_scene(draw, style);
  return proved(scene, query_of(draw, style, scene), draw.one_in(3) ? 3 : 1);
}

/// A hit with its proof.
inline Case drawn_hit(Draw& draw) {
  for (;;)
    if (Case c = drawn(draw); c.answer.outcome == Outcome::hit) return c;
}

/// Balls of radius 1, 1024 apart, and a flight along an axis that hits one of them after exactly this time.
inline Case timed(double time, int dimension = 2) {
  Scene scene = unit_scene(dimension, 1);
  for (int i = 0; i < dimension; ++i) scene.lattices[0].vectors[i][i] = 1024;
  return proved(scene, {{1023 - time, 0}, {1, 0}, {}});
}

/// Any integer matrix of determinant +-1 times the basis: as good a proof, in more rows.
inline CertificateBasis skewed(Draw& draw, CertificateBasis basis, int dimension, int steps) {
  for (; steps > 0; --steps) {
    const auto i = draw.below(dimension), j = (i + 1 + draw.below(dimension - 1)) % dimension;
    const int sign = draw.one_in(2) ? 1 : -1;
    for (int k = 0; k < dimension; ++k)
      basis[i][k] = Integer(basis[i][k].int64() + sign * basis[j][k].int64());
    if (draw.one_in(3)) std::swap(basis[i], basis[j]);
  }
  return basis;
}

}  // namespace lorentz::test::proofs
