// gjkdbg: one program, a command each (see debugger/commands/).
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <new>
#include <string_view>

#include "debugger/commands/commands.h"
#include "debugger/commands/input.h"
#include "debugger/commands/output_file.h"
#include "recordings/json_reading.h"
#include "recordings/recording.h"

namespace {

/// `"dupm" is no command; did you mean "dump"?`
std::string misspelt(const std::string& word, const std::string& what, const std::vector<std::string>& names) {
  const std::string near = gjkdbg::nearest_name(word, {names.begin(), names.end()});
  return "\"" + word + "\" is no " + what + (near.empty() ? "" : "; did you mean \"" + near + "\"?");
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

/// An option has several names ("--name,--method"), and CLI11 tells the first: here the one that was typed.
std::string as_typed(std::string message, const CLI::App& command, const std::vector<std::string>& typed) {
  constexpr std::string_view too_many = ": At Most 1 required but received ";
  if (const std::size_t at = message.find(too_many); at != message.npos) message.replace(at, message.npos, ": given " + message.substr(at + too_many.size()) + " times");
  for (const CLI::Option* option : command.get_options()) {
    const std::string first = option->get_name();
    if (!message.starts_with(first + ":") && !message.starts_with(first + " ")) continue;
    for (const std::string& name : option->get_lnames())
      if (std::any_of(typed.begin(), typed.end(), [&](const std::string& word) { return word.substr(0, word.find('=')) == "--" + name; })) return message.replace(0, first.size(), "--" + name);
  }
  return message;
}

/// What is wrong with the command line, and whose help says more. An option that there is not comes first: what stands after it may have been taken for
/// something else, or be missing.
std::string usage_error(const CLI::App& app, const CLI::ParseError& e, const std::vector<std::string>& typed) {
  const CLI::App* command = app.get_subcommands().empty() ? nullptr : app.get_subcommands().front();
  const std::string more = " (see gjkdbg " + (command ? command->get_name() + " " : "") + "--help)";
  const std::vector<std::string> words = command ? command->remaining() : app.remaining();
  for (const std::string& word : words)
    if (word.size() > 1 && word[0] == '-')
      return misspelt(word.substr(0, word.find('=')), command ? "option of " + command->get_name() : "option", option_names(command ? *command : app)) + more;
  if (command || words.empty()) return as_typed(e.what(), command ? *command : app, typed) + more;
  std::vector<std::string> names;
  for (const CLI::App* each : app.get_subcommands([](const CLI::App*) { return true; })) names.push_back(each->get_name());
  return misspelt(words[0], "command", names) + more;
}

int run(int argc, char** argv) {
  using namespace gjkdbg;
  CLI::App app("The debugger for GJK and EPA", "gjkdbg");
  app.set_version_flag("--version", generator_name());
  app.require_subcommand(1);
  app.footer("gjkdbg COMMAND --help lists a command's options. A SCENE is a file or the name of a gallery scene.\n"
             "Exit status: 0 done; 1 a finding, a difference, or an answer that is not as expected; 2 bad usage or bad input.");
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
    std::cerr << "gjkdbg: " << one_line(usage_error(app, e, {argv, argv + argc})) << "\n";
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

/// The next file that is opened takes the number of a standard stream that is closed, as of a daemon's: the errors would be written into the recording, and a solver
/// would find its standard input closed. What takes its place here can be read (it is empty) and not be written to.
void keep_standard_streams() {
  for (int stream = 0; stream <= STDERR_FILENO; ++stream)
    if (fcntl(stream, F_GETFD) < 0) open("/dev/null", O_RDONLY);
}

extern "C" void wait_for_the_end(int) {
  for (;;) pause();
}

/// Where no memory is left the program ends here: an exception would not reach `run`, because JSON values need memory even to be destroyed. Another thread that has none
/// may be ended by the C library, with words of its own (a destructor that it cannot note down): nobody hears them, and it waits.
[[noreturn]] void out_of_memory() {
  static std::atomic_flag told_already;
  while (told_already.test_and_set()) pause();  // another thread is ending the program
  std::signal(SIGABRT, wait_for_the_end);
  const int errors = dup(STDERR_FILENO), nowhere = open("/dev/null", O_WRONLY);
  if (errors >= 0 && nowhere >= 0) dup2(nowhere, STDERR_FILENO);
  gjkdbg::abandon_output();
  constexpr std::string_view said = "gjkdbg: out of memory\n";
  [[maybe_unused]] const auto told = write(errors >= 0 ? errors : STDERR_FILENO, said.data(), said.size());
  _exit(gjkdbg::exit_bad_input);
}

}  // namespace

int main(int argc, char** argv) {
  keep_standard_streams();
  std::set_new_handler(out_of_memory);
  std::signal(SIGPIPE, SIG_IGN);  // a solver or a reader that leaves early must not end the program
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow on is an error like any other
  std::signal(SIGCHLD, SIG_DFL);  // who started us may ignore it; then nobody is told how a solver ended
  const int status = run(argc, argv);
  // What was printed is done only when it has arrived; or when the other end of a pipe has had enough, as in "gjkdbg scenes | head".
  errno = 0;
  std::cout.flush();
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout) return status;
  struct stat output;
  if (fstat(STDOUT_FILENO, &output) == 0 && S_ISFIFO(output.st_mode)) return status;
  if (status != gjkdbg::exit_bad_input) std::cerr << "gjkdbg: standard output: cannot be written" << (errno != 0 ? std::string(": ") + std::strerror(errno) : "") << "\n";
  return gjkdbg::exit_bad_input;
}
