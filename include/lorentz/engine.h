/* A first-hit engine as a shared library, for `lorentz judge --engine lib:FILE.so` and wherever else an engine
 * is named. C99 or C++; needs no other header of this project. examples/library_engine.c is one to copy:
 *     cc -O2 -shared -fPIC -I include -o mine.so mine.c
 * What a scene, a query and an answer mean is in docs/formats.md.
 *
 * The library is loaded in a process of its own, and one thread calls its functions there, one call at a time:
 * the version first; then, for each scene, prepare, answer as often as there are queries, release. A crash, an
 * exit or silence is a finding, and the library is loaded anew (docs/command_engines.md).
 *
 * All numbers are binary64 values and mean exactly what they are. Indices count from 0. d is the dimension. */
#ifndef LORENTZ_ENGINE_H
#define LORENTZ_ENGINE_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The version of this interface. */
#define LORENTZ_ENGINE_INTERFACE 1

/* A scene. Its arrays are the caller's; they stay as they are until lorentz_engine_release returns.
 *   ranks       [lattices]: the number k of a lattice's primitive vectors, 0 to d; k = d is a crystal
 *   vectors     d numbers a vector: u_1, .., u_k of lattice 0, then those of lattice 1, ..
 *   lattice_of  [atoms], ascending. Queries and answers count the atoms of each lattice from 0
 *   positions   [atoms * d]: centres, in the cell 0
 *   radii       [atoms]: of a ball; 0 of an ellipsoid
 *   shapes      [atoms * d * d]: semiaxes a_1, .., a_d, d numbers each; of a ball the radius times the axes.
 *               The obstacle is position + y_1 a_1 + .. + y_d a_d with |y| < 1 */
typedef struct lorentz_scene {
  int32_t dimension; /* d: 2 or 3 */
  int32_t lattices;  /* how many, at least 1 */
  int32_t atoms;     /* how many, of all lattices together */
  const int32_t* ranks;
  const double* vectors;
  const int32_t* lattice_of;
  const double* positions;
  const double* radii;
  const double* shapes;
} lorentz_scene;

/* Queries, a column a component: query i starts at x[0][i], .., x[d-1][i]. The caller's, until
 * lorentz_engine_answer returns; not to be written to. v is not zero, of any length. from_lattice[i] is -1, or
 * the particle leaves that obstacle, which is ignored wherever x lies. Cells have as many components as their
 * lattice has vectors; further ones are 0. Columns from d on are NULL. */
typedef struct lorentz_queries {
  int64_t count;
  const double *x[3], *v[3];
  const int32_t *from_lattice, *from_atom;
  const int64_t* from_cell[3];
} lorentz_queries;

/* Where the answers go, [count] each: the caller's, for as long. A hit has all columns, `inside` has no time;
 * else the outcome alone counts. Times are in units in which x + t v is the point of collision. A cell beyond
 * 64 bits is LORENTZ_UNDECIDED. All outcomes are -1 before the call. Write a row's outcome last: after a crash
 * the first row that has none is tried alone. */
typedef struct lorentz_answers {
  int32_t *outcome, *lattice, *atom;
  int64_t* cell[3];
  double* time;
} lorentz_answers;

enum {
  LORENTZ_HIT = 0,        /* enters this obstacle first, at that time */
  LORENTZ_NEVER = 1,      /* enters none, ever */
  LORENTZ_INSIDE = 2,     /* starts in this open obstacle */
  LORENTZ_UNDECIDED = 3,  /* the engine does not know, and says so */
  LORENTZ_UNSUPPORTED = 4 /* a valid query that this engine does not do */
};

/* What an engine keeps of a scene; the library defines it as it likes. */
typedef struct lorentz_engine lorentz_engine;

#if defined(__GNUC__)
#define LORENTZ_ENGINE_EXPORT __attribute__((visibility("default")))
#else
#define LORENTZ_ENGINE_EXPORT
#endif

/* Returns LORENTZ_ENGINE_INTERFACE. A library of another version is refused. */
LORENTZ_ENGINE_EXPORT int32_t lorentz_engine_interface(void);

/* An engine for this scene that uses at most so many threads (1 unless more were asked for). It is the
 * library's; at most one is there at a time. NULL: the scene is not supported. *why, NULL before, may then be a
 * text that says why: the library's, until its next call. */
LORENTZ_ENGINE_EXPORT lorentz_engine* lorentz_engine_prepare(const lorentz_scene* scene, int32_t threads,
                                                             const char** why);

/* Answers all queries. The time that this function takes is the engine's time. */
LORENTZ_ENGINE_EXPORT void lorentz_engine_answer(lorentz_engine* engine, const lorentz_queries* queries,
                                                 const lorentz_answers* answers);

/* Frees what lorentz_engine_prepare made; never called with NULL. */
LORENTZ_ENGINE_EXPORT void lorentz_engine_release(lorentz_engine* engine);

/* May be left out. What the engine claims to be judged by, as the line of JSON that a program prints on empty
 * input: {"engine":{"name":..,"version":..,"precision":"binary32","time_tolerance":1e-6,"dimensions":[2,3]}}.
 * The text is the library's and stays. */
LORENTZ_ENGINE_EXPORT const char* lorentz_engine_claim(void);

#ifdef __cplusplus
}
#endif

#endif
