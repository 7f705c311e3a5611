// Numbers with any fixed number of binary digits, rounded to nearest after each operation, for the search.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <cmath>

#include "src/engines/published/published_unit.hpp"

namespace lorentz {

namespace big = boost::multiprecision;

template <unsigned digits>
using BigNumber = big::number<big::cpp_bin_float<digits, big::digit_base_2>, big::et_off>;

template <unsigned digits>
struct published_search::NumberType<BigNumber<digits>> {
  static constexpr int kDigits = static_cast<int>(digits);
  static double binary64(const BigNumber<digits>& a) { return a.template convert_to<double>(); }
  static Integer integer(const BigNumber<digits>& a) {
    if (!isfinite(a)) return {};  // overflow: the answer's time is not finite either
    return Integer::from_decimal(a.template convert_to<big::cpp_int>().str()).value();
  }
};

}  // namespace lorentz
