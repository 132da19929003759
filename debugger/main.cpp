// gjkdbg: one program, a command each (see debugger/commands/).
#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <iostream>

#include "debugger/commands/commands.h"
#include "recordings/recording.h"

namespace {

/// What is printed of an error: one line, whatever names the input brought along.
std::string one_line(std::string text) {
  std::replace_if(text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; }, ' ');
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace gjkdbg;
  std::signal(SIGPIPE, SIG_IGN);  // a reader that leaves early is a write error, reported as one
  CLI::App app("The debugger for GJK and EPA", "gjkdbg");
  app.set_version_flag("--version", generator_name());
  app.require_subcommand(1);
  Status status = exit_done;
#ifdef GJKDBG_WITH_VIEW
  add_view(app, status);
  add_render(app, status);
#endif
  add_dump(app, status);
  add_verify(app, status);
  add_diff(app, status);
  add_query(app, status);
  add_check(app, status);
  add_run(app, status);
  add_sweep(app, status);
  add_chart(app, status);
  add_atlas(app, status);
  add_scenes(app, status);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e);
    std::cerr << "gjkdbg: " << one_line(e.what()) << " (see gjkdbg --help)\n";
    return exit_bad_input;
  } catch (const Error& e) {
    std::cerr << "gjkdbg: " << one_line(e.line()) << "\n";
    return exit_bad_input;
  } catch (const std::bad_alloc&) {
    std::cerr << "gjkdbg: out of memory\n";
    return exit_bad_input;
  }
  return status;
}
