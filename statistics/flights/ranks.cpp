// The messages are accounts as text. Each account covers all that a rank has done so far, so that an account
// may be replaced by a later one.
#include "statistics/flights/ranks.hpp"

#include <chrono>
#include <thread>

namespace lorentz::flights {

void Ranks::share(Account& account) {
  // All reports of the previous run have been received.
  latest_.assign(static_cast<std::size_t>(size()), {});
  at_work_ = size() - 1;
  std::string text = rank() == 0 ? account.text() : std::string();
  World::share(text);
  if (rank() != 0) account = Account::of(text);
}

void Ranks::report(const Account& account, bool last) {
  send(0, last, account.text());
}

Account Ranks::sum(const Account& own, bool wait) {
  constexpr std::chrono::milliseconds kLook{2};
  const auto receive = [&] {
    while (auto message = received()) {
      latest_[static_cast<std::size_t>(message->from)] = std::move(message->text);
      at_work_ -= message->kind;
    }
  };
  for (receive(); wait && at_work_ > 0; receive()) std::this_thread::sleep_for(kLook);
  Account sum = own;
  for (const std::string& text : latest_)
    if (!text.empty()) sum.add(Account::of(text));
  return sum;
}

}  // namespace lorentz::flights
