// What check must not overlook in recordings that contradict themselves: our own, and those of other programs.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <string>

#include "recordings/check.h"
#include "recordings/gallery.h"
#include "recordings/replay.h"
#include "tests/support/gallery_run.h"

namespace gjkdbg {
namespace {

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
  EXPECT_NE(codes(gallery_run("mpr-box-box", MethodName::mpr), [](Recording& r) { first<recorded::MprEnded>(r).normal.setZero(); }).find("inconsistent"), std::string::npos);
  EXPECT_NE(codes(gallery_run("sat-box-box", MethodName::sat), [](Recording& r) { first<recorded::SatEnded>(r).normal.setZero(); }).find("inconsistent"), std::string::npos);
  EXPECT_NE(codes(gallery_run("mpr-box-box", MethodName::mpr), [](Recording& r) { auto& v = first<recorded::PortalFound>(r).vertices; v[1] = v[0]; }).find("inconsistent"), std::string::npos);
  // Yes or no of MPR: "overlapping" needs the portal that holds the origin's ray.
  const auto no_portal = [](Recording& r) { std::erase_if(r.events, [](const Event& e) { return std::holds_alternative<recorded::PortalFound>(e); }); };
  EXPECT_NE(codes(gallery_run("mpr-yes-no", MethodName::mpr), no_portal), "");
}

TEST(CheckRecord, ContactPointsLostOrTwice) {
  EXPECT_EQ(codes(gallery_run("box-contact-patch"), [](Recording& r) { r.result.contacts->pop_back(); }), "inconsistent ");
  EXPECT_NE(codes(gallery_run("box-contact-patch"), [](Recording& r) { r.result.contacts->at(1) = r.result.contacts->at(0); }).find("wrong-contact"), std::string::npos);
}

TEST(CheckRecord, StepsOfACastAreWithinTheInterval) {
  for (const double time : {-0.5, 1.5}) EXPECT_NE(codes(gallery_run("cast-slow-approach"), [&](Recording& r) { first<recorded::CastAdvanced>(r).time = time; }).find("wrong-time"), std::string::npos);
}

TEST(CheckRecord, ContactsOfASimulationLeadFromTheFirstToTheSecond) {
  EXPECT_NE(codes(gallery_run("sim-falling-box"), [](Recording& r) { first<recorded::ContactFound>(r).normal *= -1; }).find("flipped-normal"), std::string::npos);
  EXPECT_NE(codes(gallery_run("sim-falling-box"), [](Recording& r) { first<recorded::ContactFound>(r).normal *= 2; }).find("wrong-normal"), std::string::npos);
  const auto other = [](Recording& r) {
    auto& contact = first<recorded::ContactFound>(r);
    contact.depth += 0.25;
    for (Event& e : r.events)
      if (auto* again = std::get_if<recorded::ContactFound>(&e); again && again->time == contact.time && again->pair == contact.pair) again->depth = contact.depth;
  };
  EXPECT_NE(codes(gallery_run("sim-falling-box"), other).find("wrong-contact"), std::string::npos);
}

/// Of other programs: what follows from their own lists, and nothing about how they number or order their steps.
TEST(CheckRecord, OtherProgramsListsHoldEverythingOnce) {
  const auto theirs = [](const std::function<void(Recording&)>& change) {
    Recording recording = gallery_run("box-box-deep");
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

/// Every number of a recording in turn, as large as no scene makes it: squares of it are infinite, and so is what a comparison allows for.
TEST(CheckRecord, NumbersWhoseSquaresAreNone) {
  for (const double huge : {1e160, -1e160}) {
    EXPECT_NE(codes(gallery_run("sim-falling-box"), [&](Recording& r) { first<recorded::ImpulseApplied>(r).impulse[0] = huge; }).find("out-of-range"), std::string::npos);
    EXPECT_NE(codes(gallery_run("sim-newtons-cradle"), [&](Recording& r) { first<recorded::State>(r).bodies[0].velocity[0] = huge; }).find("out-of-range"), std::string::npos);
    EXPECT_NE(codes(gallery_run("sim-falling-box"), [&](Recording& r) { first<recorded::State>(r).bodies[0].angular_velocity[0] = huge; }), "");
    EXPECT_NE(codes(gallery_run("sim-falling-box"), [&](Recording& r) { first<recorded::State>(r).energy = huge; }), "");
    EXPECT_NE(codes(gallery_run("projections-ellipses", MethodName::projections), [&](Recording& r) { first<recorded::PointPredicted>(r).point[0] = huge; }), "");
    EXPECT_NE(codes(gallery_run("projections-ellipses", MethodName::projections), [&](Recording& r) { first<recorded::ProjectionsBegan>(r).point[0] = huge; }), "");
    EXPECT_NE(codes(gallery_run("cast-ray"), [&](Recording& r) { first<recorded::SupportQueried>(r).direction[0] = huge; }), "");
  }
  EXPECT_EQ(codes(gallery_run("mpr-box-box", MethodName::mpr), [](Recording& r) { r.result.lower_bound = -1e160; }), "inconsistent ");
}

/// What the steps make known is said, and nothing else.
TEST(CheckRecord, BoundsLeftOutOrLoosened) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const auto told = [](const char* scene, MethodName method, const std::function<void(Recording&)>& change) { EXPECT_NE(codes(gallery_run(scene, method), change), "") << scene; };
  told("box-box-apart", MethodName::gjk, [&](Recording& r) { first<recorded::SimplexReduced>(r).lower_bound = none; });
  told("box-box-apart", MethodName::gjk, [&](Recording& r) { first<recorded::GjkEnded>(r).upper_bound = none; });
  told("box-box-deep", MethodName::gjk, [&](Recording& r) { first<recorded::PolytopeGrown>(r).lower_bound = none; });
  told("boolean-hit-3d", MethodName::gjk_boolean, [&](Recording& r) { first<recorded::GjkEnded>(r).lower_bound = -5; });
  told("sat-box-box", MethodName::sat, [&](Recording& r) { first<recorded::AxisTested>(r).lower_bound = none; });
  told("sat-box-box", MethodName::sat, [](Recording& r) { first<recorded::AxisTested>(r).upper_bound = 7; });
  told("sat-box-box", MethodName::sat, [](Recording& r) { r.result.upper_bound = 0.4; });
  told("sat-polygons-apart", MethodName::sat, [](Recording& r) { first<recorded::PointsProjected>(r).lower_bound = -2; });
  told("sat-polygons-apart", MethodName::sat, [](Recording& r) { r.result.lower_bound = -2; });
  told("mpr-box-box", MethodName::mpr, [](Recording& r) { first<recorded::PortalFound>(r).lower_bound -= 0.1; });
  told("mpr-box-box", MethodName::mpr, [](Recording& r) { first<recorded::PortalFound>(r).upper_bound += 0.1; });
  told("mpr-box-box", MethodName::mpr, [](Recording& r) { *r.result.upper_bound += 0.1; });
  told("projections-ellipses", MethodName::projections, [](Recording& r) { first<recorded::PointsProjected>(r).lower_bound = -3; });
  told("projections-ellipses", MethodName::projections, [&](Recording& r) { first<recorded::ProjectionsEnded>(r).upper_bound = none; });
  told("level-mesh", MethodName::gjk, [](Recording& r) { *r.result.upper_bound += 0.1; });
}

TEST(CheckRecord, NumbersThatAreNone) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(codes(gallery_run("sat-box-box", MethodName::sat), [&](Recording& r) { first<recorded::AxisTested>(r).direction[0] = none; }).find("non-finite-direction"), 0U);
  EXPECT_EQ(codes(gallery_run("projections-ellipses", MethodName::projections), [&](Recording& r) { first<recorded::PointsProjected>(r).closest[0] = none; }).find("wrong-closest"), 0U);
  EXPECT_EQ(codes(gallery_run("closed-form-capsules", MethodName::closed_form), [&](Recording& r) { first<recorded::ClosedFormEnded>(r).closest[0] = none; }).find("wrong-closest"), 0U);
  EXPECT_EQ(codes(gallery_run("closed-form-capsules", MethodName::closed_form), [&](Recording& r) { first<recorded::LinesSolved>(r).s = none; }), "inconsistent ");
}

TEST(CheckRecord, CountsFacesAndMethodsThatAreOthers) {
  for (const auto& [scene, method] : {std::pair("mpr-box-box", MethodName::mpr), std::pair("sat-box-box", MethodName::sat)})
    EXPECT_EQ(codes(gallery_run(scene, method), [](Recording& r) { ++r.result.support_calls; }), "inconsistent ");
  EXPECT_EQ(codes(gallery_run("box-box-deep"), [](Recording& r) { first<recorded::EpaEnded>(r).face = -1; }), "inconsistent ");
  for (const MethodName other : {MethodName::sat, MethodName::mpr, MethodName::projections})
    EXPECT_EQ(codes(gallery_run("pair-box-box"), [&](Recording& r) { r.settings.name = other; }), "inconsistent ") << word_of(other);
  EXPECT_NE(codes(gallery_run("sat-box-box", MethodName::sat), [](Recording& r) { r.settings.name = MethodName::gjk; }), "");
  EXPECT_EQ(codes(gallery_run("accelerated-newton", MethodName::gjk_accelerated), [](Recording& r) {
              for (Event& e : r.events)
                if (auto* reduced = std::get_if<recorded::SimplexReduced>(&e); reduced && reduced->before.size() > 1) return void(reduced->before.pop_back());
            }), "inconsistent ");
  EXPECT_EQ(codes(gallery_run("box-contact-patch"), [](Recording& r) { r.result.contacts->at(0).depth *= 1.001; }), "inconsistent ");
}

/// Of motions: what is left out, and what moves though it does not.
TEST(CheckRecord, MotionsSayAllThereIs) {
  EXPECT_EQ(codes(gallery_run("sim-falling-box"), [](Recording& r) { r.result.time.reset(); }), "inconsistent ");
  EXPECT_EQ(codes(gallery_run("sim-falling-box"), [](Recording& r) { r.result.energy.reset(); }), "inconsistent ");
  EXPECT_EQ(codes(gallery_run("sim-falling-box"), [](Recording& r) { first<recorded::State>(r).bodies[0].angular_velocity.pop_back(); }), "wrong-state ");
  EXPECT_EQ(codes(gallery_run("sim-falling-box"), [](Recording& r) { first<recorded::State>(r).bodies[1].angular_velocity[0] = 1; }), "wrong-state ");
  EXPECT_NE(codes(gallery_run("sim-falling-box"), [](Recording& r) { first<recorded::ImpulseApplied>(r).point[0] *= 1.001; }).find("wrong-contact"), std::string::npos);
  EXPECT_EQ(codes(gallery_run("cast-bounce"), [](Recording& r) { r.result.touching_at.reset(); }), "inconsistent ");
  EXPECT_EQ(codes(gallery_run("cast-bounce"), [](Recording& r) { first<recorded::CastAdvanced>(r).iteration = 0; }), "inconsistent ");
  EXPECT_EQ(codes(gallery_run("cast-ray"), [](Recording& r) {
              for (Event& e : r.events)
                if (auto* asked = std::get_if<recorded::SupportQueried>(&e); asked && asked->iteration == 4) asked->direction[0] *= 1.01;
            }), "inconsistent ");
}

}  // namespace
}  // namespace gjkdbg
