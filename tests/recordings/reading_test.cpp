// What a recording that cannot be read is told: one line, the place and what is wrong there.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "recordings/gallery.h"
#include "recordings/recording.h"

namespace gjkdbg {
namespace {

using Document = nlohmann::ordered_json;

std::string error_of(Document json, const std::string& place, const std::string& value) {
  json[Document::json_pointer(place)] = Document::parse(value);
  try {
    parse_recording(json.dump(), {});
  } catch (const Error& e) {
    return e.line();
  }
  return "none";
}

TEST(Reading, WhatIsWrongIsSaidWhereItIs) {
  const Document json = Document::parse(recording_to_text(record(read_scene(read_gallery(GJKDBG_GALLERY).file("box-box-deep")))));
  EXPECT_EQ(error_of(json, "/scene", "null"), "/scene: must be an object, not null");
  EXPECT_EQ(error_of(json, "/method", "[]"), "/method: must be an object, not array");
  EXPECT_EQ(error_of(json, "/scene/bodies/0", "null"), "/scene/bodies/0: must be an object, not null");
  EXPECT_EQ(error_of(json, "/events/2/barycentric", "[true]"), "/events/2/barycentric/0: must be a number");
}

/// A flat difference has no answering face; all else has a number.
TEST(Reading, OnlyTheEndOfEpaMayNameNoFace) {
  const Document json = Document::parse(recording_to_text(record(read_scene(read_gallery(GJKDBG_GALLERY).file("box-box-deep")))));
  for (std::size_t i = 0; i < json["events"].size(); ++i) {
    const std::string kind = json["events"][i]["kind"], place = "/events/" + std::to_string(i) + (kind == "polytope_seeded" ? "/faces/1/face" : "/face");
    if (kind != "polytope_seeded" && kind != "face_chosen" && kind != "epa_ended") continue;
    EXPECT_EQ(error_of(json, place, "-1"), kind == "epa_ended" ? "none" : place + ": must be a whole number from 0 to 2147483647");
  }
}

}  // namespace
}  // namespace gjkdbg
