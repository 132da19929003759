// Words of gnuplot's that several pictures use.
#pragma once

#include <string>

namespace gjkdbg {

/// As gnuplot reads it back, whatever stands in it. A command is a line, so the end of one is a text of its own.
inline std::string quoted_for_gnuplot(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? "''" : c == '\n' ? "'.\"\\n\".'" : std::string(1, c);
  return out + "'";
}

/// The title of a picture and the note below it are alike in all of them.
inline constexpr const char *title_look = " font ',15' textcolor rgb '#14171d'", *note_look = " font ',10' textcolor rgb '#5a6472'";

}  // namespace gjkdbg
