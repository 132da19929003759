// What check must not overlook in recordings that contradict themselves: our own, and those of other programs.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>

#include "recordings/check.h"
#include "recordings/gallery.h"
#include "recordings/replay.h"

namespace gjkdbg {
namespace {

Recording own(const char* scene, MethodName method = MethodName::gjk) {
  SceneFile file = read_scene(read_gallery(GJKDBG_GALLERY).file(scene));
  if (!file.scene.motion) change_name(file.method, method);
  return record(file);
}

/// The codes told of a right recording that was changed.
std::string codes(Recording recording, const std::function<void(Recording&)>& change) {
  EXPECT_TRUE(check(recording).empty()) << check(recording)[0].message;
  change(recording);
  std::string out;
  for (const Finding& f : check(recording))
    if (out.find(f.code) == std::string::npos) out += f.code + " ";
  return out;
}

/// The first event of a kind.
template <class E>
E& first(Recording& recording) {
  return std::get<E>(*std::find_if(recording.events.begin(), recording.events.end(), [](const Event& e) { return std::holds_alternative<E>(e); }));
}

TEST(CheckRecord, EndsOfMprAndSat) {
  EXPECT_NE(codes(own("mpr-box-box", MethodName::mpr), [](Recording& r) { first<recorded::MprEnded>(r).normal.setZero(); }).find("inconsistent"), std::string::npos);
  EXPECT_NE(codes(own("sat-box-box", MethodName::sat), [](Recording& r) { first<recorded::SatEnded>(r).normal.setZero(); }).find("inconsistent"), std::string::npos);
  EXPECT_NE(codes(own("mpr-box-box", MethodName::mpr), [](Recording& r) { auto& v = first<recorded::PortalFound>(r).vertices; v[1] = v[0]; }).find("inconsistent"), std::string::npos);
  // Yes or no of MPR: "overlapping" needs the portal that holds the origin's ray.
  const auto no_portal = [](Recording& r) { std::erase_if(r.events, [](const Event& e) { return std::holds_alternative<recorded::PortalFound>(e); }); };
  EXPECT_NE(codes(own("mpr-yes-no", MethodName::mpr), no_portal), "");
}

TEST(CheckRecord, ContactPointsLostOrTwice) {
  EXPECT_EQ(codes(own("box-contact-patch"), [](Recording& r) { r.result.contacts->pop_back(); }), "inconsistent ");
  EXPECT_NE(codes(own("box-contact-patch"), [](Recording& r) { r.result.contacts->at(1) = r.result.contacts->at(0); }).find("wrong-contact"), std::string::npos);
}

TEST(CheckRecord, StepsOfACastAreWithinTheInterval) {
  for (const double time : {-0.5, 1.5}) EXPECT_NE(codes(own("cast-slow-approach"), [&](Recording& r) { first<recorded::CastAdvanced>(r).time = time; }).find("wrong-time"), std::string::npos);
}

TEST(CheckRecord, ContactsOfASimulationLeadFromTheFirstToTheSecond) {
  EXPECT_NE(codes(own("sim-falling-box"), [](Recording& r) { first<recorded::ContactFound>(r).normal *= -1; }).find("flipped-normal"), std::string::npos);
  EXPECT_NE(codes(own("sim-falling-box"), [](Recording& r) { first<recorded::ContactFound>(r).normal *= 2; }).find("wrong-normal"), std::string::npos);
  const auto other = [](Recording& r) {
    auto& contact = first<recorded::ContactFound>(r);
    contact.depth += 0.25;
    for (Event& e : r.events)
      if (auto* again = std::get_if<recorded::ContactFound>(&e); again && again->time == contact.time && again->pair == contact.pair) again->depth = contact.depth;
  };
  EXPECT_NE(codes(own("sim-falling-box"), other).find("wrong-contact"), std::string::npos);
}

/// Of other programs: what follows from their own lists, and nothing about how they number or order their steps.
TEST(CheckRecord, OtherProgramsListsHoldEverythingOnce) {
  const auto theirs = [](const std::function<void(Recording&)>& change) {
    Recording recording = own("box-box-deep");
    recording.generator = "another";
    return codes(recording, change);
  };
  EXPECT_NE(theirs([](Recording& r) {
              for (Event& e : r.events)
                if (auto* reduced = std::get_if<recorded::SimplexReduced>(&e); reduced && reduced->before.size() == 2) reduced->before[1] = reduced->before[0];
            }),
            "");
  EXPECT_NE(theirs([](Recording& r) { auto& v = first<recorded::PolytopeSeeded>(r).vertices; v.push_back(v[0]); }).find("inconsistent"), std::string::npos);
  EXPECT_NE(theirs([](Recording& r) {
              std::string_view limit = word_of(EpaStatus::iteration_limit);
              for (Event& e : r.events)
                if (auto* end = std::get_if<recorded::EpaEnded>(&e)) end->status = EpaStatus::iteration_limit;
              EXPECT_NE(r.result.status, limit);
            }).find("inconsistent"),
            std::string::npos);
}

}  // namespace
}  // namespace gjkdbg
