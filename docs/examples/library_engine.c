/* A first-hit engine to copy and to replace, as a shared library in plain C. It goes from cell to cell in
 * doubles, with one ball per cell on the unit square or cubic lattice. Other scenes are unsupported, and it
 * never answers `never`. The same engine as a program is naive_engine.cpp. Try
 *   cc -O2 -shared -fPIC -I include -o build/library_engine.so docs/examples/library_engine.c -lm
 *   lorentz compare --scene cubic --count 1000 --engine lib:build/library_engine.so */
#include <lorentz/engine.h>
#include <math.h>
#include <stdlib.h>

static const long kMaxCells = 10000000;
static const double kFarthest =
    1e15; /* cells from the origin: beyond, a double has no digits left for the place */

struct lorentz_engine {
  int d;
  double centre[3]; /* of the ball in the cell 0 */
  double radius; /* at most 1/2, so that a cell between lattice points sees the balls at its corners only */
};

int32_t lorentz_engine_interface(void) {
  return LORENTZ_ENGINE_INTERFACE;
}

static int is_unit_lattice(const lorentz_scene* scene) {
  int d = scene->dimension, i;
  if (scene->lattices != 1 || scene->ranks[0] != d) return 0;
  for (i = 0; i < d * d; ++i)
    if (scene->vectors[i] != (i % (d + 1) == 0)) return 0;
  return 1;
}

lorentz_engine* lorentz_engine_prepare(const lorentz_scene* scene, int32_t threads, const char** why) {
  lorentz_engine* engine;
  int k;
  (void)threads; /* one is enough */
  *why = "does one ball of radius at most 1/2 on the unit square or cubic lattice only";
  if (!is_unit_lattice(scene) || scene->atoms != 1 || !(scene->radii[0] > 0) || scene->radii[0] > 0.5)
    return NULL;
  *why = "has no memory left";
  engine = malloc(sizeof *engine);
  if (!engine) return NULL;
  engine->d = scene->dimension, engine->radius = scene->radii[0];
  for (k = 0; k < engine->d; ++k) engine->centre[k] = scene->positions[k];
  return engine;
}

void lorentz_engine_release(lorentz_engine* engine) {
  free(engine);
}

/* Is the ball at n entered before *first? LORENTZ_HIT if so; LORENTZ_INSIDE if x lies in it. */
static int meets(const lorentz_engine* engine, const double* n, const double* x, const double* v,
                 double speed2, double* first) {
  double along = 0, distance2 = 0, miss2 = 0, room, time;
  int k;
  for (k = 0; k < engine->d; ++k) {
    along += (n[k] - x[k]) * v[k] / speed2;
    distance2 += (n[k] - x[k]) * (n[k] - x[k]);
  }
  for (k = 0; k < engine->d; ++k) miss2 += (n[k] - x[k] - along * v[k]) * (n[k] - x[k] - along * v[k]);
  room = engine->radius * engine->radius - miss2;
  if (!(room > 0)) return LORENTZ_NEVER;
  if (distance2 < engine->radius * engine->radius) return LORENTZ_INSIDE;
  time = along - sqrt(room / speed2);
  if (!(time >= 0 && time < *first)) return LORENTZ_NEVER;
  *first = time;
  return LORENTZ_HIT;
}

/* Returns the outcome; the obstacle is in best, its time in *first. `from` is NULL if no obstacle is left. */
static int32_t first_hit(const lorentz_engine* engine, double* x, const double* v, const double* from,
                         double* best, double* first) {
  double cell[3] = {0}, n[3] = {0}, speed2 = 0;
  long step;
  int k, corner, d = engine->d;
  for (k = 0; k < d; ++k) {
    cell[k] = floor(x[k] -= engine->centre[k]), speed2 += v[k] * v[k];
    if (fabs(cell[k]) > kFarthest) return LORENTZ_UNDECIDED;
  }
  *first = INFINITY;
  for (step = 0; step < kMaxCells; ++step) {
    int axis = 0, is_from, outcome;
    double leave = INFINITY;
    for (corner = 0; corner < 1 << d; ++corner) {
      for (is_from = from != NULL, k = 0; k < d; ++k) {
        n[k] = cell[k] + (corner >> k & 1);
        is_from = is_from && n[k] == from[k];
      }
      outcome = is_from ? LORENTZ_NEVER : meets(engine, n, x, v, speed2, first);
      if (outcome != LORENTZ_NEVER)
        for (k = 0; k < d; ++k) best[k] = n[k];
      if (outcome == LORENTZ_INSIDE) return outcome;
    }
    for (k = 0; k < d; ++k) {
      const double t = (cell[k] + (v[k] > 0) - x[k]) / v[k];
      if (v[k] != 0 && t < leave) leave = t, axis = k;
    }
    if (*first <= leave) return LORENTZ_HIT;
    cell[axis] += v[axis] > 0 ? 1 : -1;
  }
  return LORENTZ_UNDECIDED;
}

void lorentz_engine_answer(lorentz_engine* engine, const lorentz_queries* queries,
                           const lorentz_answers* answers) {
  int64_t i;
  int k;
  for (i = 0; i < queries->count; ++i) {
    double x[3], v[3], from[3], best[3] = {0}, time = 0;
    int32_t outcome;
    for (k = 0; k < engine->d; ++k) {
      x[k] = queries->x[k][i], v[k] = queries->v[k][i];
      from[k] = (double)queries->from_cell[k][i];
    }
    outcome = first_hit(engine, x, v, queries->from_lattice[i] < 0 ? NULL : from, best, &time);
    answers->lattice[i] = answers->atom[i] = 0;
    for (k = 0; k < engine->d; ++k) answers->cell[k][i] = (int64_t)best[k];
    answers->time[i] = time;
    answers->outcome[i] = outcome; /* last */
  }
}
