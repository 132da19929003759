// dump: runs a scene, writes the recording.
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "debugger/commands/commands.h"
#include "debugger/commands/input.h"
#include "debugger/commands/output_file.h"
#include "recordings/comparison.h"

namespace gjkdbg {
namespace {

struct Dump {
  std::string scene, output;
  MethodFlags flags;

  int run() const {
    const std::string file = scene_path(scene).string();
    SceneFile read = read_scene(file);
    const Settings settings = flags.resolve(read, file);
    OutputFile kept(output);  // a place that cannot be written is told before a long run, not after it
    const Recording recording = record(read, settings);
    kept.write(recording_to_text(recording)), kept.commit();
    const auto missed = missed_expectations(read, recording.result);
    for (const std::string& what : missed) std::cerr << "gjkdbg: " << visible(file) << ": /expect: " << what << "\n";
    return missed.empty() ? exit_done : exit_difference;
  }
};

}  // namespace

void add_dump(CLI::App& app, Status& status) {
  auto dump = std::make_shared<Dump>();
  CLI::App* command = app.add_subcommand("dump", "Run a scene and write the recording");
  command->add_option("SCENE", dump->scene, "scene file, or the name of a gallery scene; - for standard input")->required()->check(named());
  command->add_option("-o,--output", dump->output, "file to write; standard output unless given")->check(named());
  dump->flags.add_to(*command);
  command->callback([dump, &status] { status = dump->run(); });
}

}  // namespace gjkdbg
