// atlas: stability where methods fail, into a folder; --gate compares with a kept result.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <limits>
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
  std::vector<std::string> methods, families;

  int run() const {
    const std::vector<Variant> columns = chosen(variants(true), methods);
    const std::vector<AtlasFamily> rows = atlas_families(quick, families);
    const Kept kept = gate.empty() ? Kept() : read_gate(gate, columns, rows, !families.empty());
    LabProgress progress;
    make_folder(output);
    const Atlas atlas = make_atlas(rows, columns, std::ref(progress));
    const std::filesystem::path folder(output);
    write_output((folder / "atlas.csv").string(), atlas_csv(atlas));
    write_output((folder / "atlas.json").string(), atlas_json(atlas));
    const auto [width, height] = atlas_picture_size(atlas);
    draw_both([&](const std::string& terminal, const std::string& file) { return atlas_gnuplot(atlas, terminal, file); }, folder / "atlas", width, height);
    print(atlas);
    progress.tell_if_interrupted(output);
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
                  << cell.parameter;
        if (cell.failed > 0) std::cout << "; " << cell.failed << " of " << atlas.families[f].cases.size() << (cell.failed == 1 ? " fails" : " fail");
        std::cout << "\n";
        if (!cell.why.empty()) std::cout << "        " << cell.why << "\n";
      }
    }
  }

  /// By family and method.
  using Kept = std::map<std::pair<std::string, std::string>, KeptCell>;

  static int count_of(ObjectReader& object, const char* name, int unless) {
    const Json* count = object.optional(name);
    return count ? read_integer(*count, object.at(name), 0, 1'000'000) : unless;
  }

  /// Of what will be measured: of the methods, and where families are chosen of these.
  static Kept read_gate(const std::string& file, const std::vector<Variant>& columns, const std::vector<AtlasFamily>& rows, bool only_these) {
    const std::string text = read_text_file(file);
    Kept kept;
    const auto each = [](const Json& json, const Place& place, const auto& read) {
      if (!json.is_array()) reject(place, "wrong-type", "must be an array");
      for (std::size_t i = 0; i < json.size(); ++i) read(ObjectReader(json[i], Place(place, i)), Place(place, i));
    };
    try {
      const Json json = parse_json(text);
      const Place root;
      ObjectReader top(json, root);
      if (read_string(top.required("format"), top.at("format")) != "gjk-atlas") reject(top.at("format"), "wrong-format", "must be \"gjk-atlas\"");
      read_integer(top.required("version"), top.at("version"), 1, 1);
      const Place at_families = top.at("families");
      each(top.required("families"), at_families, [&](ObjectReader family, const Place& here) {
        const std::string name = read_string(family.required("name"), Place(here, "name"));
        const Place at_cells(here, "cells");
        const int cases = count_of(family, "cases", 0);
        each(family.required("cells"), at_cells, [&](ObjectReader cell, const Place& at) {
          const std::string method = read_string(cell.required("method"), Place(at, "method"));
          KeptCell was{static_cast<Verdict>(read_enum(cell.required("verdict"), Place(at, "verdict"), verdict_names)), cases, count_of(cell, "failed", -1), std::numeric_limits<double>::infinity()};
          if (const Json* error = cell.optional("worst_error"); error && !error->is_null()) was.worst_error = read_number(*error, Place(at, "worst_error"));
          const bool row = !only_these || std::any_of(rows.begin(), rows.end(), [&](const AtlasFamily& f) { return f.name == name; });
          if (row && std::any_of(columns.begin(), columns.end(), [&](const Variant& v) { return v.name == method; })) kept[{name, method}] = was;
        });
      });
      if (kept.empty()) reject(at_families, "wrong-count", "has no cell of these families and methods: nothing to compare with");
    } catch (const Error& e) {
      throw e.in(file);
    }
    return kept;
  }

  /// Whether any cell that was kept is worse now, or not there to be compared.
  static bool compare(const Atlas& atlas, const Kept& kept) {
    std::size_t worse = 0;
    for (const auto& [cell, was] : kept) {
      std::string how = "kept, but not measured: " + cell.first + ", " + cell.second + ": " + word_of(was.verdict);
      for (std::size_t f = 0; f < atlas.families.size(); ++f)
        for (std::size_t m = 0; m < atlas.methods.size(); ++m) {
          if (atlas.families[f].name != cell.first || atlas.methods[m].name != cell.second) continue;
          how = worse_than_kept(atlas.cells[f][m], static_cast<int>(atlas.families[f].cases.size()), was, atlas.methods[m].peer != nullptr);
          if (!how.empty()) how = "worse than kept: " + cell.first + ", " + cell.second + ": " + how;
        }
      if (how.empty()) continue;
      ++worse;
      std::cout << how << "\n";
    }
    if (!kept.empty()) std::cout << "gate: " << kept.size() << " cells compared, " << (worse == 0 ? "none" : std::to_string(worse)) << " worse than kept or not measured\n";
    return worse > 0;
  }
};

}  // namespace

void add_atlas(CLI::App& app, Status& status) {
  auto options = std::make_shared<AtlasCommand>();
  CLI::App* command = app.add_subcommand("atlas", "Stability where methods fail: heat map, table, JSON into a folder");
  command->add_flag("--quick", options->quick, "fewer cases");
  command->add_option("--methods,--method", options->methods, "only methods whose names begin so: default, johnson, sat, …; an unknown name lists all");
  command->add_option("--families", options->families, "only these, by their letters (K1, C6, …), separated by commas; an unknown one lists all")->delimiter(',');
  command->add_option("-o,--output", options->output, "folder (atlas)")->check(named());
  command->add_option("--gate", options->gate, "a kept atlas.json: exit status 1 when any cell is worse (verdict; of as many cases, how many fail, and the worst error), or was not measured")->check(named());
  command->callback([options, &status] { status = options->run(); });
}

}  // namespace gjkdbg
