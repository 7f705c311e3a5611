#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>

#include <csignal>

// A name that matches no test is a failure: CTest asks for tests one by one, and what it does not find has
// not passed.
int main(int argc, char** argv) {
  std::signal(SIGINT,
              SIG_DFL);  // a shell's job in the background ignores it, and so would what is started here
  Catch::Session session;
  session.configData().warnings =
      static_cast<Catch::WarnAbout::What>(session.configData().warnings | Catch::WarnAbout::NoTests);
  return session.run(argc, argv);
}
