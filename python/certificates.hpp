// Certificates between C++ and Python. Private to python/.
#pragma once

#include <map>

#include <lorentz/certificate.hpp>
#include <lorentz/scene.hpp>
#include "python/module.hpp"

namespace lorentz::python {

/// A certificate, and the number of vectors of each of its lattices.
struct PyCertificate {
  oracle::Certificate proof;
  std::map<int, int> ranks;

  PyCertificate() = default;
  PyCertificate(oracle::Certificate certificate, const Components& count) : proof(std::move(certificate)) {
    for (const oracle::Window& w : proof.windows) ranks[w.lattice] = count.of_cells(w.lattice);
    for (const oracle::Rows& r : proof.rows) ranks[r.lattice] = count.of_cells(r.lattice);
  }
};

}  // namespace lorentz::python
