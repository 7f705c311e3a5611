/* A first-hit engine as a shared library, for `lorentz judge --engine lib:FILE.so` and everywhere else that
 * an engine is named. C99 or C++; needs no other header of this project. To begin, copy
 * docs/examples/library_engine.c of the sources:
 *     cc -O2 -shared -fPIC -I include -o mine.so mine.c
 * docs/formats.md defines scenes, queries and answers.
 *
 * The library is loaded in its own process, where one thread calls its functions, one call at a time: the
 * version first; then, for each scene, prepare, answer as often as there are queries, release. A crash, an
 * exit or silence is a finding, and the library is loaded anew (docs/command_engines.md).
 *
 * All numbers are binary64 values and are meant exactly. Indices count from 0. d is the dimension. */
#ifndef LORENTZ_ENGINE_H
#define LORENTZ_ENGINE_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The version of this interface. */
#define LORENTZ_ENGINE_INTERFACE 1

/* A scene. Its arrays belong to the caller and do not change until lorentz_engine_release returns.
 *   ranks       [lattices]: the number k of a lattice's primitive vectors, 0 to d; k = d is a crystal
 *   vectors     d numbers per vector: u_1, .., u_k of lattice 0, then those of lattice 1, ..
 *   lattice_of  [atoms], ascending. Queries and answers count the atoms of each lattice from 0
 *   positions   [atoms * d]: centres, in the cell 0
 *   radii       [atoms]: the radius of a ball; 0 for an ellipsoid
 *   shapes      [atoms * d * d]: semiaxes a_1, .., a_d, d numbers each; for a ball the radius times the axes.
 *               The obstacle is position + y_1 a_1 + .. + y_d a_d with |y| < 1 */
typedef struct lorentz_scene {
  int32_t dimension; /* d: 2 or 3 */
  int32_t lattices;  /* number of lattices, at least 1 */
  int32_t atoms;     /* number of atoms in all lattices together */
  const int32_t* ranks;
  const double* vectors;
  const int32_t* lattice_of;
  const double* positions;
  const double* radii;
  const double* shapes;
} lorentz_scene;

/* Queries, one column per component: query i starts at x[0][i], .., x[d-1][i]. The columns belong to the
 * caller, are valid until lorentz_engine_answer returns, and must not be written to. v is not zero and has
 * any length. from_lattice[i] is -1, or the particle leaves that obstacle, which is ignored wherever x lies.
 * A cell has as many components as its lattice has vectors; further components are 0. Columns from d on are
 * NULL. */
typedef struct lorentz_queries {
  int64_t count;
  const double *x[3], *v[3];
  const int32_t *from_lattice, *from_atom;
  const int64_t* from_cell[3];
} lorentz_queries;

/* The answers, [count] each. The columns belong to the caller and are valid as long as the queries. A hit
 * fills all columns, `inside` all but the time; otherwise only the outcome counts. Times are in units in
 * which x + t v is the point of collision. If a cell is beyond 64 bits, the outcome is LORENTZ_UNDECIDED. All
 * outcomes are -1 before the call. Write a row's outcome last: after a crash the first row without an outcome
 * is tried alone. */
typedef struct lorentz_answers {
  int32_t *outcome, *lattice, *atom;
  int64_t* cell[3];
  double* time;
} lorentz_answers;

enum {
  LORENTZ_HIT = 0,        /* enters this obstacle first, at this time */
  LORENTZ_NEVER = 1,      /* never enters an obstacle */
  LORENTZ_INSIDE = 2,     /* starts in this open obstacle */
  LORENTZ_UNDECIDED = 3,  /* the engine does not know the answer */
  LORENTZ_UNSUPPORTED = 4 /* a valid query that this engine does not support */
};

/* What an engine keeps for a scene; the library defines it as it likes. */
typedef struct lorentz_engine lorentz_engine;

#if defined(__GNUC__)
#define LORENTZ_ENGINE_EXPORT __attribute__((visibility("default")))
#else
#define LORENTZ_ENGINE_EXPORT
#endif

/* Returns LORENTZ_ENGINE_INTERFACE. A library with another version is refused. */
LORENTZ_ENGINE_EXPORT int32_t lorentz_engine_interface(void);

/* Makes an engine for this scene that uses at most `threads` threads (1 unless more were requested). The
 * engine belongs to the library; at most one exists at a time. Returns NULL if the scene is not supported.
 * Then *why, which is NULL before, may point to a text that says why; the text belongs to the library and
 * stays valid until its next call. */
LORENTZ_ENGINE_EXPORT lorentz_engine* lorentz_engine_prepare(const lorentz_scene* scene, int32_t threads,
                                                             const char** why);

/* Answers all queries. The time that this function takes is the engine's time. */
LORENTZ_ENGINE_EXPORT void lorentz_engine_answer(lorentz_engine* engine, const lorentz_queries* queries,
                                                 const lorentz_answers* answers);

/* Frees what lorentz_engine_prepare made; never called with NULL. */
LORENTZ_ENGINE_EXPORT void lorentz_engine_release(lorentz_engine* engine);

/* Optional. The claims by which the engine is judged, as the line of JSON that a program prints on empty
 * input: {"engine":{"name":..,"version":..,"precision":"binary32","time_tolerance":1e-6,"dimensions":[2,3]}},
 * with the engine's domain and its rule for starts inside (docs/formats.md).
 * The text belongs to the library and stays valid. */
LORENTZ_ENGINE_EXPORT const char* lorentz_engine_claim(void);

#ifdef __cplusplus
}
#endif

#endif
