/* A library with one fault, which the environment variable ODD names: "NAME" or "NAME AT", where AT is the first
 * coordinate of the query that it shows at (else 5). It hits the disc of cell (x, 0) at the time x. */
#include <lorentz/engine.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct lorentz_engine {
  int32_t dimension, threads;
};

static struct lorentz_engine the_engine;
static long answered;
static char text[4000];

static int is_odd(const char* name) {
  const char* odd = getenv("ODD");
  const size_t length = strlen(name);
  return odd && strncmp(odd, name, length) == 0 && (odd[length] == 0 || odd[length] == ' ');
}

static double at(void) {
  const char* blank = strchr(getenv("ODD") ? getenv("ODD") : "", ' ');
  return blank ? atof(blank) : 5;
}

/* By the signal, whatever a sanitizer makes of it. */
static void crash(void) {
  signal(SIGSEGV, SIG_DFL);
  raise(SIGSEGV);
}

/* Its number is told, so that a test sees whether it lives on. */
static void hang(void) {
  FILE* file = getenv("ODD_PID") ? fopen(getenv("ODD_PID"), "w") : NULL;
  if (file) fprintf(file, "%d\n", (int)getpid()), fclose(file);
  for (;;) sleep(1);
}

/* More than a pipe holds. */
static const char* much(void) {
  const size_t size = 200000000;
  char* const letters = malloc(size + 1);
  memset(letters, 'x', size);
  letters[size] = 0;
  return letters;
}

/* Into whatever it has open, other than the standard streams. */
static void flood(void) {
  static char letters[65536];
  int i;
  memset(letters, 'x', sizeof letters);
  for (;;)
    for (i = 3; i < 20; ++i)
      if (write(i, letters, sizeof letters) < 0) continue;
}

static void complain(int times) {
  for (; times > 0; --times) fprintf(stderr, "%0100d\n", 7);
}

__attribute__((constructor)) static void begin(void) {
  if (is_odd("crashes-when-loaded")) crash();
  if (is_odd("hangs-when-loaded")) hang();
  if (is_odd("complains-when-loaded")) complain(2000);
}

int32_t lorentz_engine_interface(void) {
  return is_odd("version") ? 99 : LORENTZ_ENGINE_INTERFACE;
}

const char* lorentz_engine_claim(void) {
  if (is_odd("claims-much")) return much();
  return "{\"engine\":{\"name\":\"odd\",\"version\":\"1\",\"precision\":\"binary32\"}}";
}

static void say(const char* name, const double* numbers, int count) {
  int i;
  sprintf(text + strlen(text), " %s", name);
  for (i = 0; i < count; ++i) sprintf(text + strlen(text), " %g", numbers[i]);
}

static const char* description(const lorentz_scene* scene, int32_t threads) {
  const int d = scene->dimension;
  int i, vectors = 0;
  sprintf(text, "d %d threads %d lattices %d atoms %d ranks", d, (int)threads, (int)scene->lattices,
          (int)scene->atoms);
  for (i = 0; i < scene->lattices; ++i) {
    sprintf(text + strlen(text), " %d", (int)scene->ranks[i]);
    vectors += scene->ranks[i];
  }
  say("vectors", scene->vectors, vectors * d);
  strcat(text, " lattice_of");
  for (i = 0; i < scene->atoms; ++i) sprintf(text + strlen(text), " %d", (int)scene->lattice_of[i]);
  say("positions", scene->positions, scene->atoms * d);
  say("radii", scene->radii, scene->atoms);
  say("shapes", scene->shapes, scene->atoms * d * d);
  return text;
}

lorentz_engine* lorentz_engine_prepare(const lorentz_scene* scene, int32_t threads, const char** why) {
  if (is_odd("describes")) {
    *why = description(scene, threads);
    return NULL;
  }
  if (is_odd("unsupported")) return NULL;
  if (is_odd("refuses-at-length")) {
    *why = much();
    return NULL;
  }
  if (is_odd("hangs-on-scene")) hang();
  if (is_odd("crashes-on-scene") && scene->radii[0] == 0.25) crash();
  if (is_odd("slow-scene")) usleep(500000);
  if (is_odd("noisy")) printf("%0100d\n", 7), fflush(stdout);
  the_engine.dimension = scene->dimension, the_engine.threads = threads;
  return &the_engine;
}

void lorentz_engine_release(lorentz_engine* engine) {
  if (is_odd("crashes-when-released")) crash();
  if (is_odd("exits-when-released")) exit(engine->dimension);
}

/* A fault that shows before the answer to a query is written. */
static void act(double x) {
  if (is_odd("dies-after-calls") && answered >= at()) exit(6);
  if (is_odd("crashes-always")) crash();
  if (is_odd("hangs-always")) hang();
  if (is_odd("complains")) complain(1);
  if (x != at()) return;
  if (is_odd("crashes")) crash();
  if (is_odd("aborts")) abort();
  if (is_odd("exits")) exit(3);
  if (is_odd("ends")) exit(0);
  if (is_odd("hangs")) hang();
  if (is_odd("floods")) flood();
}

static void answer(const lorentz_queries* queries, int64_t i, const lorentz_answers* answers) {
  const double x = queries->x[0][i];
  int32_t outcome = LORENTZ_HIT;
  act(x);
  answers->lattice[i] = answers->atom[i] = 0;
  answers->cell[0][i] = (int64_t)x, answers->cell[1][i] = 0;
  answers->time[i] = x;
  if (is_odd("tells-from") && queries->from_lattice[i] >= 0)
    answers->time[i] = 1000 + 100 * queries->from_lattice[i] + 10 * queries->from_atom[i] +
                       (double)queries->from_cell[0][i] / 10 + (double)queries->from_cell[1][i] / 100;
  if (is_odd("slow")) usleep(2000);
  if (x == at()) {
    if (is_odd("outcome")) outcome = 7;
    if (is_odd("silent")) outcome = -1;
    if (is_odd("lattice")) answers->lattice[i] = 1;
    if (is_odd("atom")) answers->atom[i] = 4;
    if (is_odd("negative-atom")) answers->atom[i] = -1;
    if (is_odd("not-a-number")) answers->time[i] = NAN;
    if (is_odd("never")) outcome = LORENTZ_NEVER;
    if (is_odd("inside")) outcome = LORENTZ_INSIDE;
    if (is_odd("undecided")) outcome = LORENTZ_UNDECIDED;
    if (is_odd("unsupported-query")) outcome = LORENTZ_UNSUPPORTED;
  }
  answers->outcome[i] = outcome;
  ++answered;
}

void lorentz_engine_answer(lorentz_engine* engine, const lorentz_queries* queries,
                           const lorentz_answers* answers) {
  static long alone;
  int64_t i;
  (void)engine;
  if (is_odd("alone") && queries->count == 1 && ++alone > at()) abort();
  for (i = 0; i < queries->count; ++i)
    answer(queries, is_odd("backwards") ? queries->count - 1 - i : i, answers);
  if (is_odd("backwards"))
    for (i = 0; i < queries->count; ++i)
      if (queries->x[0][i] == at()) crash();
}
