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
    {"in these steps", "What has been done up to this step. Of all supports of a motion some are no steps: those that make sure when the bodies touch, that look ahead along a normal, or measure where a ray has ended."},
    {"apart until", "Until this time they are surely apart."},
    {"touching at", "At this time they surely touch, within the tolerance."},
    {"w = a - b", "A point of A \xE2\x88\x92 B."},
    {"its distance", "From O: the depth is at least that."},
    {"its normal", "Of length 1, outwards. Along it is asked next how far A \xE2\x88\x92 B reaches."},
    {"removed / added", "What the new point sees of the polytope is removed; what joins it to the rest is added."},
};

/// And for what can be chosen in the scene's panel.
constexpr GlossaryEntry choice_meanings[] = {
    {"intersect", "Whether the bodies have a point in common: yes or no."},
    {"distance", "How far apart they are, and where they are nearest; of an overlap only that there is one."},
    {"penetration", "How far apart they are, or how deep they overlap, along which normal, and at which points."},
    {"contact", "The same, and the points of their contact area, as for a physics engine."},
    {"cast", "When the bodies first touch as they move."},
    {"simulate", "How the bodies move under gravity, with contacts and friction."},
    {"gjk", "Gilbert, Johnson and Keerthi's: a simplex of supports walks towards the origin, as it is mostly taught."},
    {"gjk-boolean", "The same walk for a yes or no: it ends at the first plane that separates."},
    {"gjk-accelerated", "The same walk with directions that look ahead, for fewer steps."},
    {"mpr", "Minkowski portal refinement: a portal along one ray is moved outwards. Quick, but of an overlap it finds a way out, not the shortest."},
    {"sat", "Separating axes: of boxes and polytopes it tries every direction that could be the answer."},
    {"closed-form", "A formula, for bodies whose cores are points and segments: spheres and capsules."},
    {"projections", "Each body's point nearest to the other's, in turn, by formulas."},
    {"fastest", "Whichever of these the charts show to be fastest for these bodies."},
    {"conservative-advancement", "Goes on in time by as much as surely nothing is reached in, and measures the distance again."},
    {"ray-cast", "Casts a ray against A â B: one search instead of many, for bodies that do not turn."},
    {"root-finding", "Looks for the time when the gap along the normal closes, as one looks for the root of a function."},
    {"signed-volumes", "By the signs of volumes, areas and lengths (Montanari): the default, right to the last bits."},
    {"johnson", "By determinants (Johnson 1988), with a backup where rounding spoils them."},
    {"voronoi", "By asking which corner, edge or face the origin lies before (Ericson)."},
    {"nesterov", "Nesterov's momentum: of the last direction a share that grows from step to step, the rest looks ahead; -v where that no longer helps."},
    {"polyak", "The heavy ball: -v, and of the last direction a share that shrinks from step to step; -v alone where that no longer helps."},
    {"newton", "By how the supports of round bodies move with the direction."},
    {"smoothed", "In the first steps a mean of -v and the direction of the best plane so far."},
    {"bounds", "When what is proven from below and from above agrees within the tolerance."},
    {"van-den-bergen", "When |v| and the best plane so far agree within the tolerance (van den Bergen 1999)."},
    {"bullet", "As Bullet does it: by a constant of its own, of the squares."},
    {"jolt", "As Jolt does it: when |v| hardly falls any more."},
    {"opengjk", "As openGJK does it: by constants of its own, one of them a length, and after 25 steps."},
    {"centres", "Along the line from one body's centre to the other's."},
    {"given", "Along a direction of yours."},
    {"previous", "With the simplex that the last run ended with: for bodies that have moved a little."},
    {"epa", "The expanding polytope: the shortest way out."},
    {"none", "Nobody: that they overlap is all that is told."},
    {"double", "16 digits."},
    {"float", "7 digits."},
};

}  // namespace

std::string meaning_of_choice(std::string_view name) {
  for (const auto& [choice, meaning] : choice_meanings)
    if (name == choice) return meaning;
  return "";
}

std::string glossary(std::string_view name) {
  for (const auto& [heading, meaning] : heading_meanings)
    if (name.starts_with(heading)) return meaning;
  for (const auto& [row, meaning] : row_meanings)
    if (name == row) return meaning;
  return "";
}

}  // namespace gjkdbg
