/* Judges answers with a golden set alone (docs/golden.md).
     runner SET ANSWERS [ULPS]: a line for each record, its id and a verdict; how many fail on stderr.
     ULPS is above 0 and at most 16. Status 1: an answer is wrong, missing, or an error; 2: a file is unfit.
     cc -std=c11 runner.c -lcjson -lm -o runner    (libcjson-dev) */
#define _POSIX_C_SOURCE 200809L
#include <cjson/cJSON.h>
#include <math.h>
#include <search.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char* text(const cJSON* object, const char* key) {
  const char* value = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(object, key));
  return value ? value : "";
}

static double number(const cJSON* object, const char* key, double otherwise) {
  const cJSON* value = cJSON_GetObjectItemCaseSensitive(object, key);
  return cJSON_IsNumber(value) ? value->valuedouble : value ? INFINITY : otherwise;
}

static const char* integer(const cJSON* n, char* room, size_t size) { /* beyond 2^53 it is a decimal string */
  if (cJSON_IsString(n)) return n->valuestring;
  if (!cJSON_IsNumber(n) || n->valuedouble != floor(n->valuedouble)) return NULL;
  snprintf(room, size, "%.0f", n->valuedouble + 0.0);
  return room;
}

static int same_integer(const cJSON* a, const cJSON* b) {
  char one[512], other[512];
  const char *m = integer(a, one, sizeof one), *n = integer(b, other, sizeof other);
  return m && n && !strcmp(m, n);
}

static int same(const cJSON* a, const cJSON* b) {
  if (strcmp(text(a, "outcome"), text(b, "outcome"))) return 0;
  if (number(a, "lattice", -1) != number(b, "lattice", -1) || number(a, "atom", -1) != number(b, "atom", -1)) return 0;
  const cJSON *one = cJSON_GetObjectItemCaseSensitive(a, "cell"), *other = cJSON_GetObjectItemCaseSensitive(b, "cell");
  if (cJSON_GetArraySize(one) != cJSON_GetArraySize(other)) return 0;
  for (int i = 0; i < cJSON_GetArraySize(one); ++i)
    if (!same_integer(cJSON_GetArrayItem(one, i), cJSON_GetArrayItem(other, i))) return 0;
  return 1;
}

static double ulp(double t, int binary32) {
  const int exponent = t > 0 ? ilogb(t) : -1074;
  return binary32 ? ldexp(1, (exponent < -126 ? -126 : exponent) - 23) : ldexp(1, exponent < -1022 ? -1074 : exponent - 52);
}

static int is_wrong_time(const cJSON* record, const cJSON* answer, double ulps, int binary32) {
  const double t = number(cJSON_GetObjectItemCaseSensitive(record, "expect"), "time", NAN);
  const double given = number(answer, "time", NAN);
  if (isnan(t) || isnan(given)) return 0; /* there is none */
  if (isinf(t) || (isinf(given) && binary32 && t > 3.4028235677973366e38)) return !isinf(given);
  return !(fabs(given - t) <= ulps * fmax(number(record, "time_change", 0), ulp(t, binary32)));
}

static const char* verdict(const cJSON* record, const cJSON* answer, double ulps, int binary32) {
  const cJSON *expect = cJSON_GetObjectItemCaseSensitive(record, "expect"), *item = NULL;
  if (!answer) return "missing";
  if (!strcmp(text(answer, "outcome"), "undecided") || !strcmp(text(answer, "outcome"), "later")) return "undecided";
  if (!strcmp(text(answer, "outcome"), "error") && strcmp(text(expect, "outcome"), "error"))
    return strcmp(text(answer, "reason"), "unsupported") ? "error" : "unsupported";
  if (same(answer, expect)) return is_wrong_time(record, answer, ulps, binary32) ? "wrong-time" : "agree";
  cJSON_ArrayForEach(item, cJSON_GetObjectItemCaseSensitive(record, "acceptable")) {
    if (same(answer, item) && number(item, "ulps", INFINITY) <= ulps) return "ill-posed";
  }
  cJSON_ArrayForEach(item, cJSON_GetObjectItemCaseSensitive(record, "tags")) {
    if (!strcmp(cJSON_GetStringValue(item), "needs-judge")) return "needs-judge";
  }
  return "wrong";
}

struct known {
  const char* id;
  cJSON* answer;
};

static int by_id(const void* a, const void* b) {
  return strcmp(((const struct known*)a)->id, ((const struct known*)b)->id);
}

/* The object in the next line that is not blank; NULL at the end. */
static cJSON* next(FILE* file, const char* name, int* number) {
  static char* line = NULL;
  static size_t room = 0;
  while (++*number, getline(&line, &room, file) > 0) {
    if (!line[strspn(line, " \t\r\n")]) continue;
    cJSON* object = cJSON_Parse(line);
    if (object) return object;
    fprintf(stderr, "%s:%d: not JSON\n", name, *number);
    exit(2);
  }
  if (ferror(file)) {
    perror(name);
    exit(2);
  }
  return NULL;
}

int main(int count, char** arguments) {
  const double ulps = count > 3 ? atof(arguments[3]) : 4;
  if (count < 3 || !(ulps > 0 && ulps <= 16))
    return fprintf(stderr, "usage: runner SET ANSWERS [ULPS]; ULPS is above 0 and at most 16\n"), 2;
  FILE *set = fopen(arguments[1], "r"), *answers = fopen(arguments[2], "r");
  if (!set || !answers) return fprintf(stderr, "cannot open %s\n", arguments[set ? 2 : 1]), 2;
  void* tree = NULL;
  int line = 0;
  for (cJSON* answer; (answer = next(answers, arguments[2], &line));) {
    struct known* entry = malloc(sizeof *entry);
    entry->answer = answer;
    entry->id = text(answer, "id");
    if (*entry->id && *(struct known**)tsearch(entry, &tree, by_id) != entry)
      return fprintf(stderr, "%s: the id %s comes twice\n", arguments[2], entry->id), 2;
  }
  int failed = 0, records = 0;
  line = 0;
  cJSON* record = next(set, arguments[1], &line);
  const cJSON* header = cJSON_GetObjectItemCaseSensitive(record, "golden");
  const int binary32 = !strcmp(text(header, "precision"), "binary32");
  const double expected = number(header, "count", -1);
  while ((record = next(set, arguments[1], &line))) {
    if (cJSON_HasObjectItem(record, "expect")) {
      const struct known key = {text(record, "id"), NULL};
      struct known** found = tfind(&key, &tree, by_id);
      const char* its = verdict(record, found ? (*found)->answer : NULL, ulps, binary32);
      printf("%s %s\n", key.id, its);
      failed += !strcmp(its, "wrong") || !strcmp(its, "missing") || !strcmp(its, "error"), ++records;
    }
    cJSON_Delete(record);
  }
  if (records != expected)
    return fprintf(stderr, "%s: needs a first line with `golden`, and as many records as its `count`\n", arguments[1]), 2;
  fprintf(stderr, "%d of %d are wrong, missing, or errors\n", failed, records);
  return failed > 0;
}
