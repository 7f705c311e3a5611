/* Asks lorentz for exact first hits, from C:
 *     cc ask.c $(pkg-config --cflags --libs lorentz-c) -o ask && ./ask
 * The four queries are those of README.md; <lorentz/lorentz.h> says what each column is. */
#include <inttypes.h>
#include <lorentz/lorentz.h>
#include <stdio.h>

static const char* const kScene =
    "{\"dimension\": 2,"
    " \"lattices\": [{\"vectors\": [[1, 0], [0, 1]], \"atoms\": [{\"position\": [0, 0], \"radius\": 0.1}]}]}";

static const char* const kOutcomes[] = {"hit",         "never", "inside", "undecided",
                                        "unsupported", "later", "far",    "invalid"};

enum { kCount = 4 };

int main(void) {
  static const double x1[kCount] = {0, 0, 0, 0.05}, x2[kCount] = {0.445, 0.445, 0.445, 0};
  static const double v1[kCount] = {0.9998476951563913, 1, 1, 1},
                      v2[kCount] = {0.01745240643728351, 0, 1e-20, 0};
  int32_t outcome[kCount];
  int64_t n1[kCount], n2[kCount];
  double time[kCount];
  lorentz_queries queries = {0}; /* no columns `from`: no particle leaves an obstacle */
  lorentz_answers answers = {0}; /* lattice and atom are left out: there is one of each */
  lorentz_asker* asker;
  int32_t status;
  int i;

  queries.count = kCount;
  queries.x[0] = x1, queries.x[1] = x2, queries.v[0] = v1, queries.v[1] = v2;
  answers.outcome = outcome, answers.cell[0] = n1, answers.cell[1] = n2, answers.time = time;

  asker = lorentz_open(kScene, NULL);
  status = lorentz_first_hits(asker, &queries, NULL, &answers);
  if (lorentz_why(asker) != NULL) fprintf(stderr, "ask: %s\n", lorentz_why(asker));
  for (i = 0; i < kCount && status <= LORENTZ_BAD_ROWS; ++i)
    printf("%s, cell (%" PRId64 ", %" PRId64 "), time %.17g\n", kOutcomes[outcome[i]], n1[i], n2[i], time[i]);
  lorentz_close(asker);
  return status;
}
