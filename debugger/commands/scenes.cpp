// scenes: the gallery, a line each.
#include <CLI/CLI.hpp>
#include <iomanip>
#include <iostream>
#include <memory>

#include "debugger/commands/commands.h"
#include "debugger/commands/input.h"

namespace gjkdbg {
namespace {

int run_scenes() {
  const Gallery gallery = read_gallery(gallery_directory());
  for (const Lesson& lesson : gallery.lessons) {
    for (const std::string& name : lesson.scenes) {
      const Scene scene = read_scene(gallery.file(name)).scene;
      std::cout << std::left << std::setw(38) << name << " " << scene.dimension << "D  " << std::setw(12) << word_of(scene.query) << std::setw(28) << lesson.title << " " << one_line(scene.description) << "\n";
    }
  }
  return exit_done;
}

}  // namespace

void add_scenes(CLI::App& app, Status& status) {
  CLI::App* command = app.add_subcommand("scenes", "The gallery, a line each");
  command->callback([&status] { status = run_scenes(); });
}

}  // namespace gjkdbg
