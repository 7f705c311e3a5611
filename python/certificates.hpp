// Certificates between C++ and Python. Private to python/.
#pragma once

#include <lorentz/certificate.hpp>
#include "python/module.hpp"

namespace lorentz::python {

/// A certificate of an answer in so many dimensions.
struct PyCertificate {
  oracle::Certificate proof;
  int dimension = 0;
};

}  // namespace lorentz::python
