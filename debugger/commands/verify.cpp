// verify: runs recordings again, names the first event that differs. diff: where two recordings part.
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "debugger/commands/commands.h"
#include "debugger/commands/input.h"
#include "recordings/comparison.h"
#include "recordings/recording.h"

namespace gjkdbg {
namespace {

void print(const Difference& d, const std::string& left_name, const std::string& right_name) {
  std::cout << d.what;
  for (std::size_t i = 0; i < d.fields.size(); ++i) std::cout << (i == 0 ? ": " : ", ") << d.fields[i];
  std::cout << "\n  " << visible(left_name) << ": " << (d.left.empty() ? "(has ended)" : d.left) << "\n  " << visible(right_name) << ": "
            << (d.right.empty() ? "(has ended)" : d.right) << "\n";
}

int run_verify(const std::vector<std::string>& files) {
  int status = exit_done;
  for (const std::string& file : files) {
    try {
      const Recording recording = read_recording(input_path(file));
      if (const auto difference = verify(recording)) {
        std::cout << visible(file) << ": differs at ";
        print(*difference, "recorded", "now");
        if (foreign(recording)) std::cout << "  It was made by " << visible(recording.generator) << ", and this is what our own method does: `check` judges the recording itself.\n";
        if (status == exit_done) status = exit_difference;
      } else {
        std::cout << visible(file) << ": same, " << recording.events.size() << " events\n";
      }
    } catch (const Error& e) {
      std::cerr << "gjkdbg: " << one_line(e.line()) << "\n";
      status = exit_bad_input;
    }
  }
  return status;
}

int run_diff(const std::string& a, const std::string& b) {
  const Recording left = read_recording(input_path(a)), right = read_recording(input_path(b));
  const auto difference = first_difference(left, right);
  if (difference) {
    std::cout << "differ at ";
    print(*difference, a, b);
  } else {
    std::cout << "same, " << left.events.size() << " events\n";
  }
  if (const std::vector<std::string> premises = differing_premises(left, right); !premises.empty())
    std::cout << "  (The " << (premises.size() == 2 ? "scenes and the methods" : premises[0] + "s") << " are not the same; only steps and results are compared.)\n";
  return difference ? exit_difference : exit_done;
}

}  // namespace

void add_verify(CLI::App& app, Status& status) {
  auto files = std::make_shared<std::vector<std::string>>();
  CLI::App* command = app.add_subcommand("verify", "Run recordings again; name the first event that differs");
  command->add_option("RECORDING", *files, "recordings; - for standard input")->required()->check(named());
  command->callback([files, &status] { status = run_verify(*files); });
}

void add_diff(CLI::App& app, Status& status) {
  auto files = std::make_shared<std::pair<std::string, std::string>>();
  CLI::App* command = app.add_subcommand("diff", "The first event where two recordings part, and both sides of it");
  command->add_option("A", files->first, "recording; - for standard input")->required()->check(named());
  command->add_option("B", files->second, "recording; - for standard input")->required()->check(named());
  command->callback([files, &status] { status = run_diff(files->first, files->second); });
}

}  // namespace gjkdbg
