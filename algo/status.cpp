#include "algo/status.h"

#include <mutex>
#include <set>
#include <string>

namespace gjkdbg {

StatusWord StatusWord::kept(std::string_view text) {
  static std::mutex one_at_a_time;
  static std::set<std::string, std::less<>> texts;  // its elements stay where they are
  const std::lock_guard lock(one_at_a_time);
  const auto found = texts.find(text);
  return StatusWord(found != texts.end() ? *found : *texts.emplace(text).first);
}

}  // namespace gjkdbg
