// What the names in the two pictures stand for: for whoever sees O, v, d and w for the first time and points at them.
#include "debugger/view/app.h"
#include "debugger/view/explain.h"

namespace gjkdbg {
namespace {

const std::string minus = "\xE2\x88\x92";

/// `cores`: what is drawn is the difference of those.
std::string in_difference(const std::string& name, const Frame& frame, bool cores) {
  const std::string a = body_letter(frame.pair[0]), b = body_letter(frame.pair[1]), difference = a + " " + minus + " " + b;
  if (name == "O") return "O, the origin. The bodies overlap exactly if it lies in " + difference + ": a point of " + a + " less one of " + b + " is zero where the two are the same point.";
  if (name == "v") {
    const std::string length = frame.closest ? " It is " + short_number(frame.closest->norm()) + " away, and " + difference + " is no farther." : "";
    return "v, the point of the simplex nearest to O." + length + " Points nearer still are looked for along " + minus + "v.";
  }
  if (name == "d") return "d, the direction asked along: which point of " + difference + " lies farthest that way?";
  if (name == "w") return "w, the support: of all points of " + difference + " one farthest along d. Nothing of " + difference + " lies beyond the plane through it, across d.";
  if (name == "depth" || name == "depth of the cores") return "The way out: moved by as much along it, body " + b + " just leaves body " + a + ". None that was found is shorter.";
  if (name.starts_with("face ") || name.starts_with("edge ") || name.starts_with("endpoint ")) return "The one nearest to O. How far " + difference + " reaches beyond it is asked along its normal.";
  if (name.starts_with("nearest: ")) return "The one nearest to O, which should have been chosen: the distance of another is no lower bound of the depth.";
  if (name.starts_with("region ")) return "Whatever lies here has its nearest point of the simplex on the vertices named. O lies here, so the others are not needed.";
  if (name.ends_with("dropped")) return "A vertex that is dropped: the point nearest to O does without it.";
  const std::string near = "the border of " + difference + " comes at least this near.", far = "nothing of the border is nearer.", of = cores ? " of the cores" : "";
  if (name == "depth at least") return "As far from O as the depth" + of + " is at least: " + far;
  if (name == "depth at most") return "As far from O as the depth" + of + " is at most: " + near;
  if (name == "at most") return "As far from O as the distance" + of + " is at most: " + near;
  if (name == "at least") return "As far from O as the distance" + of + " is at least: " + far;
  if (name == "inside") return "A point inside " + difference + ". MPR looks where the ray from here through O leaves.";
  if (name == "x") return "x, how far along r the origin surely gets before it meets " + difference + ".";
  if (name == "r") return "r, the motion of " + b + " less that of " + a + ": O moves along it while " + difference + " stands still.";
  if (name == "c") return "c, a corner of " + difference + ": where the segments of both begin.";
  if (name == "s = 1") return "s counts along the segment of " + a + ", from 0 at c to 1 here.";
  if (name == "t = 1") return "t counts along the segment of " + b + ", from 0 at c to 1 here.";
  if (name.size() == 1) return "Vertex " + name + " of the simplex. Its dot has the numbers.";
  return "";
}

std::string in_world(const std::string& name, const Frame& frame, const Recording& recording) {
  const std::string a = body_letter(frame.pair[0]), b = body_letter(frame.pair[1]);
  const bool projected = std::holds_alternative<recorded::PointsProjected>(recording.events[frame.step]);
  const bool answered = frame.step + 1 == recording.events.size() && recording.result.witness_a;  // the supports have no names any more then
  if (name == "witness a" || name == "witness b" || (answered && (name == "a" || name == "b"))) {
    const bool overlap = recording.result.signed_distance && *recording.result.signed_distance < 0;
    return overlap ? "The witnesses of the overlap: moved by the depth along n, " + b + " just touches " + a + ", and the two are one point." : "The witnesses of the distance: points of " + a + " and " + b + " nearest to each other.";
  }
  const auto support = [&](const std::string& other) { return " With " + other + " it makes the support, w = a " + minus + " b."; };
  if (name == "a") return projected ? "a, the point of " + a + " that is nearest to b." : "a, the point of " + a + " farthest along d." + support("b");
  if (name == "b") return projected ? "b, the point of " + b + " that is nearest to a." : "b, the point of " + b + " farthest along " + minus + "d." + support("a");
  if (name == "d") return "d, the direction asked along.";
  if (name == "-d") return "Against d: the farther b lies that way, the farther a " + minus + " b lies along d.";
  if (name == "n") return "n, the unit normal, from " + a + " towards " + b + ".";
  if (name == "x") return "x, where the next look begins.";
  if (!name.empty() && name.find_first_not_of("0123456789") == std::string::npos) return "Contact point " + name + ". The panel says where it is.";
  if (name.starts_with("velocity")) return "Where the body moves to; the longer, the faster: the longest arrow of the whole motion is the fastest.";
  if (name.starts_with("turning")) return "The axis that the body turns about, counter-clockwise seen from the arrow's tip; the longer, the faster.";
  if (name == "impulse") return "The push that one body gets at this point, and the other the opposite one. Its length is in the numbers beside, not in the arrow.";
  return "";
}

}  // namespace

std::string meaning_of(const std::string& label, bool world, const Frame& frame, const Recording& recording) {
  std::string name = label;
  if (name.starts_with("w #")) name = "w";
  if (name != "s = 1" && name != "t = 1") name = name.substr(0, name.find(" = "));  // "v = A": one dot with two names
  return world ? in_world(name, frame, recording) : in_difference(name, frame, rounded(recording.scene.scene) && recording.settings.name != MethodName::gjk_boolean);
}

}  // namespace gjkdbg
