// Holds the implementation of a class, which its header does not show.
#pragma once

#include <memory>
#include <utility>

#include <lorentz/errors.hpp>

namespace lorentz {

/// Kept out of its callers, because a throw beside a hot path takes a tenth of a flight's time.
[[noreturn, gnu::cold, gnu::noinline]] inline void throw_moved_from() {
  throw InputError("this object is empty: it was moved from; assign another to it, or use that one");
}

/// Moves with the class. A moved-from object is empty, and its use throws InputError.
template <class T>
class Pimpl {
 public:
  Pimpl() = default;
  template <class U>
  Pimpl(std::unique_ptr<U> value) : value_(std::move(value)) {}

  T* operator->() const {
    if (!value_) [[unlikely]]
      throw_moved_from();
    return value_.get();
  }
  T& operator*() const { return *operator->(); }

 private:
  std::unique_ptr<T> value_;
};

}  // namespace lorentz
