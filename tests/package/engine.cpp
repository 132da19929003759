// Records a query of its own and writes the recording.
#include <fstream>

#include "recordings/recording.h"

int main(int, char** argv) {
  using namespace gjkdbg;
  SceneFile file;
  file.scene.name = "engine pair 17";
  const AnyVector half = AnyVector::Constant(3, 0.5);
  for (const double x : {0.0, 0.9}) {
    Body body{"crate", {Box{-half, half, true}, 0}, identity_pose(3)};
    body.pose.position[0] = x;
    file.scene.bodies.push_back(body);
  }
  const Recording recording = record(file);
  std::ofstream(argv[1]) << recording_to_text(recording);
  return recording.result.intersecting ? 0 : 1;
}
