/* Exact first hits for programs in C, and in whatever calls C: Julia, Fortran, JavaScript, .. C99 or C++.
 * docs/library.md tells how to link, docs/examples/ask.c is a program to begin with. The columns of queries
 * and answers are those of engine.h, the interface for engines of your own; nothing else of it is used here.
 *
 * No exception leaves the library, no call prints or keeps anything but in its asker. Any number of askers may
 * be in use at a time, each by one thread at a time. */
#ifndef LORENTZ_LORENTZ_H
#define LORENTZ_LORENTZ_H

#include <lorentz/engine.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The version of this interface: compare it with what lorentz_interface returns. */
#define LORENTZ_INTERFACE 1

/* Outcomes besides those of engine.h. LORENTZ_FAR is a hit, or `inside` if the time is NaN, in a cell that 64
 * bits do not hold: the columns of the cell are 0. Exact engines never answer LORENTZ_UNDECIDED. */
enum {
  LORENTZ_LATER = 5,  /* enters no obstacle before max_time */
  LORENTZ_FAR = 6,    /* as a hit or inside; the cell is beyond 64 bits */
  LORENTZ_INVALID = 7 /* the row is not a query: lorentz_why says why */
};

/* What lorentz_first_hits returns. */
enum {
  LORENTZ_DONE = 0,     /* all queries are answered */
  LORENTZ_BAD_ROWS = 1, /* all but those with the outcome LORENTZ_INVALID; lorentz_why tells of the first */
  LORENTZ_REFUSED = 2,  /* nothing is answered: lorentz_why tells what to change */
  LORENTZ_FAILED = 3    /* memory or a device failed: ignore what was written */
};

/* A scene, an engine, and what was wrong with the last call. */
typedef struct lorentz_asker lorentz_asker;

/* Returns the LORENTZ_INTERFACE of the library. */
LORENTZ_ENGINE_EXPORT int32_t lorentz_interface(void);

/* Makes an asker. `scene` is the text of a scene file, JSON or TOML (docs/formats.md), all of whose keys must be
 * known. `engine` is an engine of lorentz (docs/command_engines.md). NULL is "certified-batch", exact and fast:
 * its answers are those of "oracle", to the bit of the time. Both texts end with 0 and are not needed afterwards.
 * If lorentz_why(asker) is not NULL, the scene or the name was refused. Close the asker all the same. */
LORENTZ_ENGINE_EXPORT lorentz_asker* lorentz_open(const char* scene, const char* engine);

/* Answers all queries, and returns a status of those above. max_time is a column of limits above 0, or NULL.
 * The columns of engine.h have to be there, except that `from` may be NULL in all its columns, and of the
 * answers all but the outcome. Every row of an answer's column is written: what the outcome does not have is 0,
 * or NaN for a time. The time of an exact engine is the exact one, rounded to the nearest binary64. */
LORENTZ_ENGINE_EXPORT int32_t lorentz_first_hits(lorentz_asker* asker, const lorentz_queries* queries,
                                                 const double* max_time, const lorentz_answers* answers);

/* Says what was wrong with the asker's last call, and where; NULL if nothing was. The text stays as it is until
 * the next call with this asker. */
LORENTZ_ENGINE_EXPORT const char* lorentz_why(const lorentz_asker* asker);

/* Frees the asker; does nothing for NULL. */
LORENTZ_ENGINE_EXPORT void lorentz_close(lorentz_asker* asker);

#ifdef __cplusplus
}
#endif

#endif
