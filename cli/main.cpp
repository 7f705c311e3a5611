#include "cli/app.hpp"

int main(int argc, char** argv) {
  return lorentz::cli::run(argc, argv);
}
