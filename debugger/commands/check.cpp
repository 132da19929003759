// check: what is wrong with a recording, first wrong step first.
#include "recordings/check.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "debugger/commands/commands.h"
#include "debugger/commands/findings.h"
#include "debugger/commands/input.h"

namespace gjkdbg {

void print_findings(const std::vector<Finding>& findings, bool json, std::ostream& out) {
  if (json) {
    out << findings_to_json(findings);
    return;
  }
  for (const Finding& f : findings)
    out << "step " << f.step << ": " << (f.severity == Finding::Severity::error ? "error" : "warning") << ": " << f.code << "\n  " << visible(f.message) << "\n";
  if (findings.empty()) out << "no findings: every step holds\n";
}

namespace {

struct Check {
  std::string file;
  bool json = false;

  int run() const {
    const std::vector<Finding> findings = check(read_recording(input_path(file)));
    print_findings(findings, json, std::cout);
    return findings.empty() ? exit_done : exit_difference;
  }
};

}  // namespace

void add_check(CLI::App& app, Status& status) {
  auto options = std::make_shared<Check>();
  CLI::App* command = app.add_subcommand("check", "What is wrong with a recording, first wrong step first");
  command->add_option("RECORDING", options->file, "recording, of any implementation; - for standard input")->required()->check(named());
  command->add_flag("--json", options->json, "findings as JSON");
  command->callback([options, &status] { status = options->run(); });
}

}  // namespace gjkdbg
