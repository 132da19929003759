// What the headings and the rows of the step's panel mean: for whoever points at them.
#include <string_view>
#include <utility>

#include "debugger/view/app.h"

namespace gjkdbg {
namespace {

using GlossaryEntry = std::pair<std::string_view, const char*>;

/// By how they begin: "VERTEX #4, newest". The first that fits. Of an algorithm its letters, a line each.
constexpr GlossaryEntry heading_meanings[] = {
    {"SIMPLEX", "The points of A \xE2\x88\x92 B that the search holds: at most four in space, three in the plane, two on a line. The bars are the weights that make v of them, the point of their hull nearest to O: none is negative, and together they are 1."},
    {"EVERY PART", "Where on the simplex is v? Every part is tried: its corners, edges, triangles. O is projected onto it. When no weight (\xCE\xBB) is negative the foot lies in the part, and the number is how far it is from O. The nearest foot is v, and only its part is kept."},
    {"SIGNED DISTANCE", "How far apart the bodies are; below 0, how deep they overlap. What is proven so far: it lies between these two numbers."},
    {"DISTANCE TO THE TRIANGLE", "How far the body is from this triangle of the mesh; below 0, how deep it overlaps. What is proven so far: it lies between these two numbers."},
    {"POLYTOPE", "A hull of points of A \xE2\x88\x92 B that holds O. EPA lets it grow until what is nearest to O of its border is border of A \xE2\x88\x92 B, too: as far is the way out."},
    {"RESULT", "What the method answers at the end."},
    {"VERTEX", "A point w of A \xE2\x88\x92 B, and the points a of A and b of B that it is the difference of. Click a vertex in a picture to read of it here."},
    {"SO FAR", "What it has taken up to this step. Every support is a question to both bodies: which of your points lies farthest along d?"},
    {"GJK", "O: the origin.\nsupport(d): a point of A \xE2\x88\x92 B farthest along d.\nW: the simplex, of such points.\nv: the point of its hull nearest to O.\nWhen v is O the bodies overlap; when nothing lies farther along -v than v, its length is their distance."},
    {"EPA", "O: the origin.\nsupport(d): a point of A \xE2\x88\x92 B farthest along d.\n|f|: how far f is from O.\nWhat w sees of the polytope is what it lies outside of."},
    {"MPR", "O: the origin.\nv0: a point inside A \xE2\x88\x92 B.\nsupport(n): a point of A \xE2\x88\x92 B farthest along n.\nPortal: a triangle of such points (in the plane an edge) that the ray from v0 through O passes."},
    {"SAT", "n: an axis, of length 1.\nsupport(n): a point of A \xE2\x88\x92 B farthest along n.\nn.w: how far the bodies overlap along n; below 0 there is a gap.\nOnly these few axes need be tried."},
    {"Projections", "Each body's point nearest to the other's is looked for in turn, until both stand still.\nw: a support, which proves that nothing is nearer."},
    {"Closed form", "p, q: the two segments, a0, b0 where they begin.\ns, t count along them from 0 to 1.\nA dot is the scalar product."},
    {"Conservative advancement", "t: the time.\nd, n: the distance then, and the normal it is measured along.\nAs they come nearer by at most the bound per unit of time, they stay apart until d / bound is over."},
    {"Root finding", "t: the time.\nd, n: the distance then, and the normal it is measured along.\nThe next t is when the gap along n closes."},
    {"Ray cast", "r: the motion of B less that of A.\nx: how far along r the origin surely gets.\nP: the simplex.\nv leads from the point of P nearest x to x."},
    {"Response", "What bodies that have met do for the rest of the time: slide on along what they hit, or bounce off it."},
    {"Rigid bodies", "h: the time step.\nP: momentum. m: mass. g: gravity.\nx, R: where a body is and how it is turned.\nAn impulse is a push: it changes the momentum at once."},
};

/// The same for the rows below them: as they are.
constexpr GlossaryEntry row_meanings[] = {
    {"at most", "The upper bound: the bodies are no farther apart, for two points of theirs are as near."},
    {"at least", "The lower bound: the bodies are no nearer, for along some direction there is that much room between them; below 0: no deeper, for moved by as much they are apart."},
    {"gap", "Between the bounds. When it is within the tolerance the search ends."},
    {"intersecting", "Whether the bodies have a point in common."},
    {"signed distance", "How far apart the bodies are; below 0, how deep they overlap."},
    {"signed distance, about", "How far apart the bodies are; below 0, how deep they overlap. The bounds have not met, so it is not certain."},
    {"normal", "Of length 1, from the first body towards the second: along it the distance or the depth is measured."},
    {"witness a", "The point of A nearest to B; of an overlap, the one deepest inside B."},
    {"witness b", "The point of B nearest to A; of an overlap, the one deepest inside A."},
    {"support calls", "How often the bodies were asked for the point that lies farthest along a direction."},
    {"apart until", "Until this time they are surely apart."},
    {"touching at", "At this time they surely touch, within the tolerance."},
    {"w = a - b", "A point of A \xE2\x88\x92 B."},
    {"its distance", "From O: the depth is at least that."},
    {"its normal", "Of length 1, outwards. Along it is asked next how far A \xE2\x88\x92 B reaches."},
    {"removed / added", "What the new point sees of the polytope is removed; what joins it to the rest is added."},
};

}  // namespace

std::string glossary(std::string_view name) {
  for (const auto& [heading, meaning] : heading_meanings)
    if (name.starts_with(heading)) return meaning;
  for (const auto& [row, meaning] : row_meanings)
    if (name == row) return meaning;
  return "";
}

}  // namespace gjkdbg
