#include "report/calls.hpp"

#include <algorithm>
#include <cmath>

#include "src/exchange/json_writer.hpp"

namespace lorentz::report {
namespace {

std::size_t* place_of(Call& call, oracle::Verdict verdict) {
  switch (verdict) {
    case oracle::Verdict::agree:
      return &call.right;
    case oracle::Verdict::ill_posed:
      return &call.ill_posed;
    case oracle::Verdict::wrong:
      return &call.wrong;
    case oracle::Verdict::undecided:
      return &call.undecided;
    default:
      return nullptr;
  }
}

}  // namespace

void Calls::add(std::optional<double> size, oracle::Verdict verdict, std::optional<double> radii_off) {
  const double its = std::fabs(size.value_or(0));
  Call none;
  if (!(its > 0) || !std::isfinite(its) || !place_of(none, verdict)) return;
  Call& call = by_decade_[static_cast<int>(std::floor(std::log10(its)))];
  ++*place_of(call, verdict);
  call.radii_off = std::max(call.radii_off, radii_off.value_or(0));
}

void Calls::add(int decade, const Call& call) {
  Call& its = by_decade_[decade];
  for (const auto part : {&Call::right, &Call::ill_posed, &Call::wrong, &Call::undecided})
    its.*part += call.*part;
  its.radii_off = std::max(its.radii_off, call.radii_off);
}

void Calls::add(const Calls& others) {
  for (const auto& [decade, call] : others.by_decade_) add(decade, call);
}

void append_json(std::string& out, const Calls& calls) {
  out += json::text_of(json::objects(calls.by_decade(), [](json::Members& one, const auto& decade) {
    const auto& [exponent, call] = decade;
    one.add("decade", exponent, "right", call.right, "ill_posed", call.ill_posed, "wrong", call.wrong,
            "undecided", call.undecided, "radii_off", call.radii_off);
  }));
}

Calls calls_of(json::Array array) {
  Calls calls;
  json::each_element(array, [&](json::Value element) {
    json::Object one = element.object();
    const int decade = static_cast<int>(one["decade"].integer());
    Call call{one["right"].natural(), one["ill_posed"].natural(), one["wrong"].natural(),
              one["undecided"].natural()};
    call.radii_off = read_number(one["radii_off"], "radii_off");
    calls.add(decade, call);
  });
  return calls;
}

}  // namespace lorentz::report
