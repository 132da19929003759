// libFuzzer: reading any bytes as a recording or a scene ends in a value or in an Error, and what was read replays and runs.
#include <cstdint>

#include "recordings/replay.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gjkdbg;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const Recording recording = parse_recording(text, "/nonexistent");
    if (!recording.events.empty()) frame_at(recording, recording.events.size() - 1);
  } catch (const Error&) {
  }
  try {
    SceneFile scene = parse_scene(text, "/nonexistent");
    scene.method.max_iterations = 64;
    record(scene);
  } catch (const Error&) {
  }
  return 0;
}
