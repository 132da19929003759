// run: another implementation on a scene, under the debugger, then check.
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <optional>

#include "debugger/commands/commands.h"
#include "debugger/commands/findings.h"
#include "debugger/commands/input.h"
#include "debugger/commands/output_file.h"
#include "debugger/solver/solver_run.h"
#include "recordings/comparison.h"

namespace gjkdbg {
namespace {

struct Run {
  std::string scene, command, output;
  bool json = false;
  SolverLimits limits;
  MethodFlags flags;

  int run() const {
    const std::string file = scene_path(scene).string();
    const SceneFile read = read_scene(file);
    std::optional<OutputFile> kept;
    if (!output.empty()) kept.emplace(output);  // a place that cannot be written is told before the run, not after it
    const Recording recording = solved(read, file);
    if (kept) kept->write(recording_to_text(recording)), kept->commit();
    const std::vector<Finding> findings = check(recording);
    print_findings(findings, json, output == "-" ? std::cerr : std::cout);
    const std::vector<std::string> missed = missed_by_solver(read, recording);
    for (const std::string& what : missed) std::cerr << "gjkdbg: " << visible(file) << ": /expect: " << what << "\n";
    return findings.empty() && missed.empty() ? exit_done : exit_difference;
  }

 private:
  Recording solved(const SceneFile& read, const std::string& file) const {
    SceneFile asked = read;
    asked.method = method_for_solver(read.method);
    const Settings settings = flags.resolve(asked, file);
    try {
      return run_solver(read, settings, command, limits);
    } catch (const Error& e) {
      throw e.where().starts_with("/") ? e.in(file) : e;  // of the scene, or of the program
    }
  }
};

}  // namespace

void add_run(CLI::App& app, Status& status) {
  auto options = std::make_shared<Run>();
  CLI::App* command = app.add_subcommand("run", "Run your own GJK on a scene, then check what it did");
  command->add_option("SCENE", options->scene, "scene file, or the name of a gallery scene")->required()->check(named());
  command->add_option("--exec", options->command, "the program, as a shell would start it")->required()->check(named());
  command->add_option("-o,--output", options->output, "file for the recording")->check(named());
  command->add_flag("--json", options->json, "findings as JSON");
  command->add_option("--max-supports,--max_supports", options->limits.max_supports, "support queries (1000)")->transform(whole_between(1, 10000000));
  command->add_option("--timeout", options->limits.timeout, "seconds for the whole run (10)")->check(between(0.01, 86400.0));
  options->flags.add_to(*command);
  command->callback([options, &status] { status = options->run(); });
}

}  // namespace gjkdbg
