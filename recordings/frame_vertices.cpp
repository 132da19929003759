#include "recordings/frame_vertices.h"

#include <algorithm>

namespace gjkdbg {

std::map<int, std::vector<std::size_t>> index_vertices(const Recording& recording) {
  std::map<int, std::vector<std::size_t>> index;
  for (std::size_t i = 0; i < recording.events.size(); ++i)
    if (const auto e = given_vertex(recording.events[i])) index[e->vertex].push_back(i);
  return index;
}

void fill_vertices(Frame& frame, const Recording& recording, const std::map<int, std::vector<std::size_t>>& index) {
  frame.vertices.clear();
  const auto need = [&](int vertex) {
    const auto found = index.find(vertex);
    if (found == index.end()) return;
    const auto after = std::upper_bound(found->second.begin(), found->second.end(), frame.step);
    if (after == found->second.begin()) return;
    const GivenVertex given = *given_vertex(recording.events[*(after - 1)]);
    frame.vertices[vertex] = {vertex, *(after - 1), given.a, given.b, given.w};
  };
  if (frame.newest) need(*frame.newest);
  for (const auto* list : {&frame.simplex, &frame.dropped, &frame.seeds, &frame.portal})
    for (const int v : *list) need(v);
  for (const auto& [number, face] : frame.faces)
    for (const int v : face.vertices) need(v);
  for (const FrameFace& face : frame.removed)
    for (const int v : face.vertices) need(v);
}

}  // namespace gjkdbg
