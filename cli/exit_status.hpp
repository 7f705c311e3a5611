// The exit status of the program. If several apply, it is the largest.
#pragma once

namespace lorentz::cli {

enum ExitStatus : int {
  kDone = 0,
  kDisagreement = 1,  ///< a wrong answer was found
  kBadInput = 2,      ///< bad usage or bad input
  kFailed = 3         ///< the work could not be done because of a file, a store or a subprocess
};

}  // namespace lorentz::cli
