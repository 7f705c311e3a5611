// Ranks by MPI. What is sent are accounts, as text; each is all that a rank has done so far, so that one that
// is overtaken by the next is not missed.
#include <mpi.h>

#include <boost/mpi.hpp>
#include <boost/serialization/string.hpp>
#include <chrono>
#include <cstdlib>
#include <thread>

#include "flights/ranks.hpp"

namespace lorentz::flights {
namespace {

namespace mpi = boost::mpi;

enum Message { kSoFar = 1, kLast };

// A wait inside MPI keeps a processor busy.
constexpr std::chrono::milliseconds kLook{2};

}  // namespace

struct Ranks::Impl {
  mpi::environment environment{mpi::threading::funneled, false};
  mpi::communicator world;
  std::vector<std::string> latest;  // of this run, from each rank
  int at_work = 0;

  // All of a run's reports have been received before the next one is shared.
  void begin() {
    latest.assign(static_cast<std::size_t>(world.size()), "");
    at_work = world.size() - 1;
  }

  void receive() {
    while (const auto status = world.iprobe()) {
      world.recv(status->source(), status->tag(), latest[static_cast<std::size_t>(status->source())]);
      at_work -= status->tag() == kLast;
    }
  }
};

std::unique_ptr<Ranks> Ranks::join() {
  const char* size = std::getenv("OMPI_COMM_WORLD_SIZE");
  if (!size) size = std::getenv("PMI_SIZE");
  if (!size || std::atoi(size) < 2) return nullptr;
  return std::unique_ptr<Ranks>(new Ranks(std::make_unique<Impl>()));
}

Ranks::Ranks(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Ranks::~Ranks() = default;

int Ranks::rank() const {
  return impl_->world.rank();
}
int Ranks::size() const {
  return impl_->world.size();
}

void Ranks::share(Account& account) {
  impl_->begin();
  std::string text = rank() == 0 ? account.text() : std::string();
  mpi::broadcast(impl_->world, text, 0);
  if (rank() != 0) account = Account::of(text);
}

void Ranks::report(const Account& account, bool last) {
  impl_->world.send(0, last ? kLast : kSoFar, account.text());
}

Account Ranks::sum(const Account& own, bool wait) {
  impl_->receive();
  while (wait && impl_->at_work > 0) {
    std::this_thread::sleep_for(kLook);
    impl_->receive();
  }
  Account sum = own;
  for (const std::string& text : impl_->latest)
    if (!text.empty()) sum.add(Account::of(text));
  return sum;
}

void Ranks::abort(int status) {
  impl_->world.abort(status);
  std::abort();
}

}  // namespace lorentz::flights
