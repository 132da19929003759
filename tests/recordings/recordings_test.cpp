// Files: there and back bit for bit, replay, damage.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <nlohmann/json.hpp>

#include "algo/motion.h"
#include "recordings/comparison.h"
#include "recordings/gallery.h"
#include "recordings/json_writing.h"
#include "recordings/replay.h"
#include "tests/oracle/exact_polytopes.h"
#include "tests/oracle/wide_gjk.h"
#include "tests/support/random_scenes.h"

namespace gjkdbg {
namespace {

const Gallery& gallery() {
  static const Gallery read = read_gallery(GJKDBG_GALLERY);
  return read;
}

template <class Check>
void for_gallery(Check check) {
  for (const Lesson& lesson : gallery().lessons)
    for (const std::string& name : lesson.scenes) {
      SCOPED_TRACE(name);
      check(read_scene(gallery().file(name)));
    }
}

TEST(Gallery, HasSixtyScenesAndListsEveryFileOnce) {
  std::vector<std::string> names;
  for (const Lesson& lesson : gallery().lessons) names.insert(names.end(), lesson.scenes.begin(), lesson.scenes.end());
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
  EXPECT_GE(names.size(), 60u);
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(gallery().directory)) files += entry.path().string().ends_with(".scene.json");
  EXPECT_EQ(files, names.size());
}

/// The expectations against the oracles, not against our own output.
TEST(Gallery, ExpectationsAgreeWithTheOracles) {
  int compared = 0;
  for_gallery([&](const SceneFile& file) {
    ASSERT_TRUE(file.expect) << "no expectation";
    EXPECT_FALSE(file.scene.source.empty());
    EXPECT_FALSE(file.scene.description.empty());
    const Expectation& e = *file.expect;
    if (file.scene.motion) return;  // motion_test
    if (std::holds_alternative<Mesh>(file.scene.bodies[1].shape.geometry)) return;
    if (const auto exact = oracle::signed_distance(file.scene)) {
      ++compared;
      EXPECT_EQ(e.intersecting.value_or(exact->intersecting), exact->intersecting);
      const double expected = file.scene.query == Query::distance ? std::max(0.0, exact->signed_distance) : exact->signed_distance;
      EXPECT_NEAR(e.signed_distance.value_or(expected), expected, e.tolerance);
      double nearest = 2;
      if (e.normal && !exact->normals.empty()) {
        for (const auto& n : exact->normals) nearest = std::min(nearest, (n.head(file.scene.dimension) - *e.normal).norm());
        EXPECT_LE(nearest, 1e-9) << "a normal that is none of " << exact->normals.size();
      }
    } else if (e.intersecting && !*e.intersecting && e.signed_distance) {
      ++compared;
      EXPECT_NEAR(*e.signed_distance, oracle::wide_distance(file.scene), e.tolerance);
    }
  });
  EXPECT_GE(compared, 100);
}

TEST(Gallery, AnswersAreAsExpected) {
  for_gallery([](const SceneFile& file) {
    for (const std::string& missed : missed_expectations(file, record(file).result)) ADD_FAILURE() << missed;
  });
}

TEST(Codec, RecordingsReadBackBitForBit) {
  for_gallery([](const SceneFile& file) {
    const Recording recording = record(file);
    const std::string text = recording_to_text(recording);
    const Recording again = parse_recording(text, {});
    EXPECT_EQ(recording_to_text(again), text);
    EXPECT_FALSE(first_difference(recording, again));
    EXPECT_FALSE(verify(again)) << verify(again)->what;
  });
}

TEST(Codec, NumbersReadBackBitForBit) {
  RandomScenes random(1);
  for (int i = 0; i < 20000; ++i) {
    const double x = std::ldexp(random.uniform(-1, 1), random.integer(-1070, 1020));
    std::string text;
    append_number(text, x);
    EXPECT_EQ(nlohmann::json::parse(text).get<double>(), x) << text;
  }
  std::string zero, infinite;
  append_number(zero, -0.0);
  append_number(infinite, 1.0 / 0.0);
  EXPECT_TRUE(std::signbit(nlohmann::json::parse(zero).get<double>()));
  EXPECT_EQ(infinite, "null");
}

TEST(Codec, NotesAreKeptWhereTheyStand) {
  const std::string text = R"({"format": "gjk-scene", "version": 1, "id": [7], "name": "top", "dimension": 2, "query": "distance", "bodies": [
    {"name": "A", "id": 1, "tags": ["t"], "shape": {"type": "sum", "of": [{"type": "circle", "radius": 1, "description": "round"}, {"type": "point", "points": [[0, 0]], "source": "here"}]}},
    {"shape": {"type": "box", "half_extents": [1, 1]}, "pose": {"position": [3, 0], "description": "beside", "rotation": {"angle": 30, "name": "turned"}}}],
    "method": {"name": "gjk", "description": "plain"}, "expect": {"intersecting": false, "source": "by hand"}})";
  const nlohmann::ordered_json given = nlohmann::ordered_json::parse(text);
  SceneFile file = parse_scene(text, {});
  const nlohmann::ordered_json written = scene_to_json(file), again = scene_to_json(parse_scene(written.dump(), {}));
  EXPECT_EQ(written, again);
  for (const char* note : {"/id", "/bodies/0/name", "/bodies/0/id", "/bodies/0/tags", "/bodies/0/shape/of/0/description", "/bodies/0/shape/of/1/source", "/bodies/1/pose/description", "/bodies/1/pose/rotation/name", "/method/description", "/expect/source"}) {
    const nlohmann::ordered_json::json_pointer place(note);
    ASSERT_TRUE(written.contains(place)) << note;
    EXPECT_EQ(written[place], given[place]);
  }
  EXPECT_EQ(written["method"]["name"], "gjk");
  EXPECT_EQ(nlohmann::ordered_json::parse(recording_to_text(record(file)))["scene"]["bodies"][0]["tags"], given["bodies"][0]["tags"]);
  file.scene.bodies.pop_back(), file.scene.bodies[0].name.clear(), file.method = {};  // what is no longer there is not noted either
  const nlohmann::ordered_json changed = scene_to_json(file);
  for (const char* gone : {"/bodies/1", "/bodies/0/name", "/method"}) EXPECT_FALSE(changed.contains(nlohmann::ordered_json::json_pointer(gone))) << gone;
}

TEST(Codec, DegreesReadBackToTheSameRadians) {
  RandomScenes random(2);
  for (int i = 0; i < 20000; ++i) {
    const double degrees = i % 2 == 0 ? random.uniform(-720, 720) : random.integer(-7200, 7200) / 10.0;
    const double radians = radians_from_degrees(degrees);
    EXPECT_EQ(radians_from_degrees(degrees_from_radians(radians)), radians) << degrees;
  }
  EXPECT_EQ(degrees_from_radians(radians_from_degrees(29)), 29);
  EXPECT_EQ(degrees_from_radians(radians_from_degrees(-90)), -90);
}

TEST(Codec, HundredThousandEvents) {
  Recording recording = record(read_scene(gallery().file("ellipsoids-concentric")));
  const std::vector<Event> events = recording.events;
  while (recording.events.size() < 100000) recording.events.insert(recording.events.end(), events.begin(), events.end());
  const Recording again = parse_recording(recording_to_text(recording), {});
  EXPECT_EQ(again.events.size(), recording.events.size());
}

/// What a file tells beyond what was asked for is no part of a run.
TEST(Verify, FindsWhatARunLeavesOut) {
  Recording asked = record(read_scene(gallery().file("2d-intersect-only")));
  EXPECT_FALSE(verify(asked));
  asked.result.signed_distance = 3.0, asked.result.normal = AnyVector(Eigen::Vector2d(1, 0)), asked.result.pair = {0, 1};
  const auto difference = verify(asked);
  ASSERT_TRUE(difference);
  EXPECT_EQ(difference->what, "result");
  EXPECT_EQ(difference->fields, (std::vector<std::string>{"normal", "pair", "signed_distance"}));
  Recording miss = record(read_scene(gallery().file("cast-receding")));
  EXPECT_FALSE(verify(miss));
  miss.result.lower_bound = 1.0;
  EXPECT_TRUE(verify(miss));
}

TEST(Replay, SeekingEqualsPlaying) {
  const bool fewer = pairs_asked(20000) < 20000;
  for_gallery([&](const SceneFile& file) {
    const Recording recording = record(file);
    const std::size_t count = recording.events.size();
    Replay play(recording), seek(recording);
    for (std::size_t i = 0; i < count; ++i) {
      const Frame& frame = play.at(i);
      ASSERT_TRUE(frame == frame_at(recording, i)) << i;
      const std::size_t jump = (i * 7919) % count;
      ASSERT_TRUE(seek.at(jump) == frame_at(recording, jump)) << jump;
      // Of long ones, some after the first few.
      if (fewer && i > 10) i += count / 10;
      if (!fewer && i > 40 && count > 300) i += 37;
    }
    EXPECT_THROW(frame_at(recording, count), std::out_of_range);
  });
}

/// The step that shows the answer shows its bounds, not those of the growth or the axis before.
/// Who looks at a step twice has the same frame, not one filled anew under his hands.
TEST(Replay, KeepsTheFrameOfAStep) {
  const Recording recording = record(read_scene(gallery().file("box-box-deep")));
  Replay replay(recording);
  const FrameVertex* vertex = &replay.at(8).vertices.at(1);
  EXPECT_EQ(vertex, &replay.at(8).vertices.at(1));
  EXPECT_TRUE(replay.at(9) == frame_at(recording, 9));
  EXPECT_TRUE(replay.at(9) == frame_at(recording, 9));
}

TEST(Replay, EpaAndSatEndWithTheBoundsOfTheResult) {
  int ends = 0, of_sat = 0;
  for_gallery([&](const SceneFile& file) {
    const Recording recording = record(file);
    if (file.scene.motion) return;
    for (std::size_t i = 0; i < recording.events.size(); ++i) {
      const bool sat = std::holds_alternative<recorded::SatEnded>(recording.events[i]) && i + 1 == recording.events.size() && recording.result.upper_bound;
      if (!std::holds_alternative<recorded::EpaEnded>(recording.events[i]) && !sat) continue;
      ++ends, of_sat += sat;
      EXPECT_EQ(frame_at(recording, i).lower_bound, recording.result.lower_bound);
      EXPECT_EQ(frame_at(recording, i).upper_bound, recording.result.upper_bound);
    }
  });
  EXPECT_GT(ends, 20);
  EXPECT_GE(of_sat, 3);
}

TEST(Comparison, NamesTheFirstDifference) {
  const SceneFile file = read_scene(gallery().file("box-box-deep"));
  const Recording a = record(file);
  Recording b = a;
  EXPECT_FALSE(first_difference(a, b));
  std::get<recorded::SupportQueried>(b.events[3]).w[1] += 1e-15;
  auto difference = first_difference(a, b);
  ASSERT_TRUE(difference);
  EXPECT_EQ(difference->event, 3u);
  EXPECT_EQ(difference->fields, std::vector<std::string>{"w"});
  ASSERT_EQ(difference->by.size(), 1u);
  EXPECT_NEAR(difference->by[0], 1e-15, 4e-16);
  EXPECT_EQ(verify(b)->event, 3u);
  b = a;
  b.events.pop_back();
  EXPECT_EQ(first_difference(a, b)->event, a.events.size() - 1);
  b = a;
  *b.result.signed_distance = 1;
  EXPECT_EQ(first_difference(a, b)->what, "result");
}

TEST(Comparison, PrecisionsPartWhereTheyDecideOtherwise) {
  SceneFile file = read_scene(gallery().file("box-box-deep"));
  const Recording a = record(file);
  file.method.scalar = Scalar::float_precision;
  Recording b = record(file);
  ASSERT_TRUE(first_difference(a, b));
  EXPECT_FALSE(first_other_way(a, b));
  auto cut = std::find_if(b.events.begin(), b.events.end(), [](const Event& e) { return std::holds_alternative<recorded::SimplexReduced>(e); });
  std::get<recorded::SimplexReduced>(*cut).region.clear();
  const auto parting = first_other_way(a, b);
  ASSERT_TRUE(parting);
  EXPECT_EQ(parting->event, static_cast<std::size_t>(cut - b.events.begin()));
  EXPECT_EQ(parting->fields, std::vector<std::string>{"region"});
}

TEST(Replay, NothingOfARunHoldsOnInAState) {
  const Recording recording = record(read_scene(gallery().file("cast-bounce")));
  int states = 0;
  for (std::size_t i = 0; i < recording.events.size(); ++i) {
    const Frame frame = frame_at(recording, i);
    if (std::holds_alternative<recorded::CastAdvanced>(recording.events[i])) {
      EXPECT_TRUE(frame.lower_bound && !frame.direction && !frame.newest) << i;
    }
    if (!std::holds_alternative<recorded::State>(recording.events[i])) continue;
    EXPECT_FALSE(frame.lower_bound || frame.upper_bound || frame.direction || frame.newest || frame.closest || frame.gjk_status) << i;
    EXPECT_EQ(frame.places.size(), recording.scene.scene.bodies.size());
    ++states;
  }
  EXPECT_EQ(states, 2);
}

// --- Bad input: one clear line, never a crash ----------------------------------------------------------------------

std::string error_of(const std::string& text) {
  try {
    parse_scene(text, {});
  } catch (const Error& e) {
    EXPECT_EQ(e.line().find('\n'), std::string::npos) << e.line();
    return e.where() + " " + e.code();
  }
  return "accepted";
}

std::string scene_with(const std::string& shape, const std::string& pose = "{\"position\":[0,0,0]}", const std::string& more = "") {
  return R"({"format":"gjk-scene","version":1,"dimension":3,"bodies":[{"shape":)" + shape + R"(,"pose":)" + pose +
         R"(},{"shape":{"type":"sphere","radius":1}}])" + more + "}";
}

TEST(BadScenes, AreRefusedWithTheirPlace) {
  EXPECT_EQ(error_of(scene_with(R"({"type":"sphere","radius":1})")), "accepted");
  EXPECT_EQ(error_of(""), "line 1, column 1 bad-json");
  EXPECT_EQ(error_of("{\n  \"format\": }"), "line 2, column 13 bad-json");
  EXPECT_EQ(error_of("[]"), " wrong-type");
  EXPECT_EQ(error_of("{}"), "/format missing-field");
  EXPECT_EQ(error_of(scene_with(R"({"type":"sphere","radius":-1})")), "/bodies/0/shape/radius negative-size");
  EXPECT_EQ(error_of(scene_with(R"({"type":"sphere","radius":1e999})")).find("accepted"), std::string::npos);
  EXPECT_EQ(error_of(scene_with(R"({"type":"sphere","radius":null})")), "/bodies/0/shape/radius wrong-type");
  EXPECT_EQ(error_of(scene_with(R"({"type":"sphere","radus":1})")), "/bodies/0/shape/radius missing-field");
  EXPECT_EQ(error_of(scene_with(R"({"type":"sphere","radius":1,"colour":1})")), "/bodies/0/shape/colour unknown-field");
  EXPECT_EQ(error_of(scene_with(R"({"type":"sphere","radius":1,"source":5})")), "/bodies/0/shape/source wrong-type");
  EXPECT_EQ(error_of(scene_with(R"({"type":"sphere","radius":1,"tags":["a",7]})")), "/bodies/0/shape/tags/1 wrong-type");
  EXPECT_EQ(error_of(scene_with(R"({"type":"shpere","radius":1})")), "/bodies/0/shape/type unknown-type");
  EXPECT_EQ(error_of(scene_with(R"({"type":"polygon","points":[[0,0],[1,0],[0,1]]})")), "/bodies/0/shape/type wrong-dimension");
  EXPECT_EQ(error_of(scene_with(R"({"type":"hull","points":[]})")), "/bodies/0/shape/points no-points");
  EXPECT_EQ(error_of(scene_with(R"({"type":"hull","points":[[0,0]]})")), "/bodies/0/shape/points/0 wrong-dimension");
  EXPECT_EQ(error_of(scene_with(R"({"type":"hull","mesh":"nowhere.obj"})")), "/bodies/0/shape/mesh missing-file");
  EXPECT_EQ(error_of(scene_with(R"({"type":"box","half_extents":[1,1]})")), "/bodies/0/shape/half_extents wrong-dimension");
  EXPECT_EQ(error_of(scene_with(R"({"type":"sphere","radius":1})", R"({"rotation":{"quaternion":[1,0,0,0.1]}})")), "/bodies/0/pose/rotation/quaternion not-a-rotation");
  EXPECT_EQ(error_of(scene_with(R"({"type":"sphere","radius":1})", "{}", R"(,"dimension":2)")), "/dimension duplicate-field");
  EXPECT_EQ(error_of(scene_with(R"({"type":"sphere","radius":1})", "{}", R"(,"method":{"name":"gkj"})")), "/method/name unknown-name");
}

TEST(BadScenes, WarnOfARotationThatIsSlightlyOff) {
  const SceneFile file = parse_scene(scene_with(R"({"type":"sphere","radius":1})", R"({"rotation":{"quaternion":[1,0,0,0.0001]}})"), {});
  ASSERT_EQ(file.scene.warnings.size(), 1u);
  const Recording recording = record(file);
  ASSERT_TRUE(std::holds_alternative<recorded::Warning>(recording.events.at(0)));
  EXPECT_EQ(std::get<recorded::Warning>(recording.events[0]).code, "rotation-orthonormalised");
}

TEST(BadScenes, MovingQueriesOfBodiesThatDoNotMove) {
  SceneFile file = read_scene(gallery().file("two-unit-cubes"));
  for (const Query query : {Query::cast, Query::simulate}) {
    file.scene.query = query;
    EXPECT_THROW(record(file), Error);
  }
}

/// A reading of anything ends in a recording or in an Error with one line.
bool reads(const std::string& text) {
  try {
    const Recording recording = parse_recording(text, {});
    for (std::size_t i = 0; i < recording.events.size(); ++i) frame_at(recording, i);
    return true;
  } catch (const Error& e) {
    EXPECT_EQ(e.line().find('\n'), std::string::npos);
    return false;
  }
}

TEST(DamagedRecordings, ANameWithALineBreakIsToldInOneLine) {
  EXPECT_FALSE(reads("{\"format\":\"gjk-recording\",\"version\":1,\"two\\nlines\":1}"));
  EXPECT_EQ(Error("code", "no 'a\nb\x7f'", "/c\td").line(), "/c\\x09d: no 'a\\x0ab\\x7f'");
}

TEST(DamagedRecordings, TruncatedAnywhere) {
  const std::string text = recording_to_text(record(read_scene(gallery().file("2d-deep"))));
  for (std::size_t length = 0; length + 3 < text.size(); length += 11) EXPECT_FALSE(reads(text.substr(0, length))) << length;
}

TEST(DamagedRecordings, AlteredAnywhere) {
  const std::string text = recording_to_text(record(read_scene(gallery().file("stacked-cubes"))));
  std::mt19937 random(3);
  const std::string alphabet = "0123456789-e.,:[]{}\"\\ntfalsu\0\xff";
  int survived = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string altered = text;
    for (int k = 0; k < 1 + i % 4; ++k) altered[random() % altered.size()] = alphabet[random() % alphabet.size()];
    survived += reads(altered);
  }
  EXPECT_GT(survived, 0);
  EXPECT_LT(survived, 3000);
}

TEST(DamagedRecordings, DeepNestingAndHugeNumbers) {
  EXPECT_FALSE(reads(std::string(100000, '[')));
  EXPECT_FALSE(reads(R"({"format":"gjk-recording","version":1e400})"));
  EXPECT_FALSE(reads(R"({"format":"gjk-recording","format":"gjk-recording"})"));
}

TEST(DamagedRecordings, CorpusOfTheFuzzer) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(GJKDBG_CORPUS)) {
    reads(read_text_file(entry.path()));
    ++files;
  }
  EXPECT_GT(files, 5);
}

/// Bodies turned in memory, as the charts' pairs are, have their rotation as numbers only.
TEST(Scenes, RotationsThatAreNumbersOnlyAreWritten) {
  for (const int dimension : {2, 3}) {
    SceneFile file = parse_scene(R"({"format": "gjk-scene", "version": 1, "dimension": )" + std::to_string(dimension) +
                                     R"(, "bodies": [{"shape": {"type": "point"}, "pose": {"position": [)" + (dimension == 3 ? "0, 0, 0" : "0, 0") + R"(]}},
      {"shape": {"type": "point"}, "pose": {"position": [)" + (dimension == 3 ? "1, 2, 3" : "1, 2") + R"(]}}]})", {});
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, dimension == 3 ? Eigen::Vector3d(1, 2, 3).normalized() : Eigen::Vector3d(0, 0, 1)).toRotationMatrix();
    file.scene.bodies[1].pose.matrix = turn.topLeftCorner(dimension, dimension);
    const SceneFile read = parse_scene(scene_to_json(file).dump(), {});
    EXPECT_EQ(read.scene.bodies[0].pose.matrix, file.scene.bodies[0].pose.matrix);
    EXPECT_LE((read.scene.bodies[1].pose.matrix - file.scene.bodies[1].pose.matrix).norm(), 1e-15);
  }
}

/// Of many bodies the frame names those whose points are asked for, where they are then.
TEST(Replays, NameThePairThatIsLookedAt) {
  for (const char* name : {"cast-bounce", "cast-many-bodies", "sim-stack-of-five", "sim-newtons-cradle"}) {
    const Recording recording = record(read_scene(read_gallery(GJKDBG_GALLERY).file(name)));
    const Scene& scene = recording.scene.scene;
    Replay replay(recording);
    for (std::size_t step = 0; step < std::min<std::size_t>(recording.events.size(), 1500); ++step) {
      const auto* query = std::get_if<recorded::SupportQueried>(&recording.events[step]);
      if (!query) continue;
      const Frame& frame = replay.at(step);
      for (const std::size_t k : {0, 1}) {
        const auto i = static_cast<std::size_t>(frame.pair[k]);
        ASSERT_LE(((k == 0 ? query->a : query->b) - frame.places[i].position).norm(), reach_of(scene.bodies[i].shape, scene.dimension) * (1 + 1e-9)) << name << " " << step;
      }
    }
  }
}

}  // namespace
}  // namespace gjkdbg
