// What a step means, in words with the real numbers; and the algorithm's lines with the one that runs.
#pragma once

#include <string>
#include <vector>

#include "recordings/replay.h"

namespace gjkdbg {

struct Explanation {
  std::string title;  ///< a few words
  std::string text;   ///< one or two sentences: what happened and why
};

/// `newest_first`: as the letters count, see simplex_letter.
Explanation explain(const Recording& recording, const Frame& frame, bool newest_first = true);

/// One line for a list: "w = (…)", "AB → A".
std::string summary(const Recording& recording, std::size_t step, bool newest_first = true);

struct PseudoCode {
  std::string title;
  std::vector<std::string> lines;
  int current = -1;
};
PseudoCode pseudo_code(const Recording& recording, std::size_t step);

/// Whether bodies have radii around their cores.
bool rounded(const Scene& scene);
/// Whether an advance of a cast is the last before the bodies meet.
bool meets_at(const Recording& recording, std::size_t step);
/// Whether a step is of the SAT of two boxes.
bool of_two_boxes(const Recording& recording, std::size_t step);
/// Whether SAT looks along an outline, for how deep bodies of revolution are, what is nearly balls, or ellipsoids by their bends, after GJK or EPA.
bool of_an_outline(const Recording& recording);
/// Whether it is known of which kind: of two bodies that do not move, for which that is known before.
bool outline_told(const Recording& recording);
bool of_near_balls(const Recording& recording);
bool of_tilted_axes(const Recording& recording);
bool of_bends(const Recording& recording);
/// Whether a step of SAT is one that goes on where EPA ran out of steps.
bool after_epa(const Recording& recording, std::size_t step);
/// Whether it looks by the bends: after EPA always.
bool by_bends(const Recording& recording, std::size_t step);
/// The name it has in the scene, with the pictures' letter: "bullet (A)"; "body A" where it has none.
std::string body_name(const Recording& recording, int body);
/// What a polytope's border consists of: "face"; in the plane "edge", on a line "endpoint".
std::string facet_name(const Recording& recording);
/// Vertices as A, B, C, D: by their places in `order`, from its end where not `newest_first`.
std::string letters(const std::vector<int>& vertices, const std::vector<int>& order, bool newest_first = true);

/// Short decimal: six significant digits.
std::string short_number(double x);
std::string short_vector(const AnyVector& v, int digits = 4);
/// As many as it takes of two points for their difference to be right to a hundredth, at least 4.
int digits_that_tell(const AnyVector& p, const AnyVector& q);
/// As many as it takes to tell the bodies' places apart, at least 4: far out more.
int digits_of_places(const Scene& scene);
/// A point of the world, with as many.
std::string short_place(const Recording& recording, const AnyVector& point);

}  // namespace gjkdbg
