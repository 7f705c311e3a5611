// make_page REPORT.json PAGE.html: the page of a report, for the test in a browser.
#include <exception>
#include <fstream>
#include <iostream>
#include <sstream>

#include "report/page.hpp"

int main(int argc, char** argv) try {
  if (argc != 3) {
    std::cerr << "usage: make_page REPORT.json PAGE.html\n";
    return 2;
  }
  std::stringstream json;
  json << std::ifstream(argv[1]).rdbuf();
  std::ofstream(argv[2]) << lorentz::report::page(json.str());
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 3;
}
