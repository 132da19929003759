// atlas: stability where methods fail, into a folder; --gate compares with a kept result.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <map>
#include <memory>

#include <nlohmann/json.hpp>

#include "debugger/commands/commands.h"
#include "debugger/commands/input.h"
#include "debugger/commands/lab.h"
#include "debugger/commands/output_file.h"
#include "debugger/lab/atlas.h"
#include "recordings/json_reading.h"
#include "recordings/scene_file.h"

namespace gjkdbg {
namespace {

struct AtlasCommand {
  bool quick = false;
  std::string output = "atlas", gate;
  std::vector<std::string> methods;

  int run() const {
    const auto kept = gate.empty() ? std::map<std::pair<std::string, std::string>, int>() : read_gate(gate);
    const std::vector<Variant> columns = chosen(variants(true), methods);
    make_folder(output);
    LabProgress progress;
    const Atlas atlas = make_atlas(quick, columns, std::ref(progress));
    const std::filesystem::path folder(output);
    write_output((folder / "atlas.csv").string(), atlas_csv(atlas));
    write_output((folder / "atlas.json").string(), atlas_json(atlas));
    draw_both([&](const std::string& terminal, const std::string& file) { return atlas_gnuplot(atlas, terminal, file); }, folder / "atlas", 500 + 42 * static_cast<int>(atlas.methods.size()), 1000);
    print(atlas);
    return compare(atlas, kept) ? exit_difference : exit_done;
  }

 private:
  static void print(const Atlas& atlas) {
    for (std::size_t f = 0; f < atlas.families.size(); ++f) {
      std::cout << std::left << std::setw(4) << atlas.families[f].name << atlas.families[f].what << "\n";
      for (std::size_t m = 0; m < atlas.methods.size(); ++m) {
        const AtlasCell& cell = atlas.cells[f][m];
        if (cell.verdict == Verdict::right || cell.verdict == Verdict::not_applicable) continue;
        std::cout << "      " << std::setw(26) << atlas.methods[m].name << std::setw(22) << word_of(cell.verdict) << " error " << std::setprecision(2) << cell.worst_error << " at "
                  << cell.parameter << "\n";
        if (!cell.why.empty()) std::cout << "        " << cell.why << "\n";
      }
    }
  }

  /// Verdicts by family and method.
  static std::map<std::pair<std::string, std::string>, int> read_gate(const std::string& file) {
    const std::string text = read_text_file(file);
    std::map<std::pair<std::string, std::string>, int> kept;
    try {
      const Json json = parse_json(text);
      const Place root;
      if (!json.is_object() || json.value("format", "") != "gjk-atlas" || !json.contains("families")) reject(Place(root, "format"), "wrong-format", "must be \"gjk-atlas\"");
      const Place families(root, "families");
      for (std::size_t f = 0; f < json["families"].size(); ++f) {
        const Place here(families, f);
        ObjectReader family(json["families"][f], here);
        const std::string name = read_string(json["families"][f].value("name", Json()), Place(here, "name"));
        const Json& cells = family.required("cells");
        for (std::size_t c = 0; c < cells.size(); ++c) {
          const Place at(here, c);
          ObjectReader cell(cells[c], at);
          kept[{name, read_string(cell.required("method"), cell.at("method"))}] = static_cast<int>(read_enum(cell.required("verdict"), cell.at("verdict"), verdict_names));
        }
      }
    } catch (const Error& e) {
      throw e.in(file);
    }
    return kept;
  }

  /// Whether any cell is worse than it was.
  static bool compare(const Atlas& atlas, const std::map<std::pair<std::string, std::string>, int>& kept) {
    bool worse = false;
    for (std::size_t f = 0; f < atlas.families.size(); ++f)
      for (std::size_t m = 0; m < atlas.methods.size(); ++m) {
        const auto was = kept.find({atlas.families[f].name, atlas.methods[m].name});
        const int now = static_cast<int>(atlas.cells[f][m].verdict);
        if (was == kept.end() || now <= was->second || atlas.cells[f][m].verdict == Verdict::not_applicable) continue;
        worse = true;
        std::cout << "worse than kept: " << atlas.families[f].name << ", " << atlas.methods[m].name << ": " << word_of(static_cast<Verdict>(was->second)) << " -> " << word_of(atlas.cells[f][m].verdict) << "\n";
      }
    return worse;
  }
};

}  // namespace

void add_atlas(CLI::App& app, Status& status) {
  auto options = std::make_shared<AtlasCommand>();
  CLI::App* command = app.add_subcommand("atlas", "Stability where methods fail: heat map, table, JSON into a folder");
  command->add_flag("--quick", options->quick, "fewer cases");
  command->add_option("--method", options->methods, "only methods whose names begin so: default, johnson, sat, …");
  command->add_option("-o,--output", options->output, "folder (atlas)")->check(named());
  command->add_option("--gate", options->gate, "a kept atlas.json: exit 1 when any cell is worse")->check(named());
  command->callback([options, &status] { status = options->run(); });
}

}  // namespace gjkdbg
