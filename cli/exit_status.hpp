// How the program ends; of several, the largest.
#pragma once

namespace lorentz::cli {

enum ExitStatus : int {
  kDone = 0,
  kDisagreement = 1,  ///< a wrong answer was found
  kBadInput = 2,      ///< bad usage or bad input
  kFailed = 3         ///< the work could not be done: a file, a store, a subprocess
};

}  // namespace lorentz::cli
