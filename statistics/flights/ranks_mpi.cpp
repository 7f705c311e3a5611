// Ranks by MPI. The messages are accounts as text. Each account covers all that a rank has done so far, so
// that an account may be replaced by a later one.
#include <boost/serialization/string.hpp>
#include <chrono>
#include <thread>

#include "report/runs/world_mpi.hpp"
#include "statistics/flights/ranks.hpp"

namespace lorentz::flights {
namespace {

namespace mpi = boost::mpi;

constexpr int kSoFar = 1, kLast = 2;  // messages

// The interval between polls. A wait inside MPI would keep a processor busy.
constexpr std::chrono::milliseconds kLook{2};

}  // namespace

// For rank 0: the reports of the others in this run.
struct Ranks::Inbox {
  std::vector<std::string> latest;  // from each rank
  int at_work = 0;

  explicit Inbox(int size) : latest(static_cast<std::size_t>(size)), at_work(size - 1) {}

  void receive(const mpi::communicator& world) {
    while (const auto status = world.iprobe()) {
      world.recv(status->source(), status->tag(), latest[static_cast<std::size_t>(status->source())]);
      at_work -= status->tag() == kLast;
    }
  }
};

Ranks::Ranks() = default;
Ranks::~Ranks() = default;

void Ranks::share(Account& account) {
  // All reports of the previous run have been received.
  inbox_ = std::make_unique<Inbox>(size());
  std::string text = rank() == 0 ? account.text() : std::string();
  mpi::broadcast(mpi().world, text, 0);
  if (rank() != 0) account = Account::of(text);
}

void Ranks::report(const Account& account, bool last) {
  mpi().world.send(0, last ? kLast : kSoFar, account.text());
}

Account Ranks::sum(const Account& own, bool wait) {
  inbox_->receive(mpi().world);
  while (wait && inbox_->at_work > 0) {
    std::this_thread::sleep_for(kLook);
    inbox_->receive(mpi().world);
  }
  Account sum = own;
  for (const std::string& text : inbox_->latest)
    if (!text.empty()) sum.add(Account::of(text));
  return sum;
}

}  // namespace lorentz::flights
