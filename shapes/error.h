// Bad input: the one exception type that crosses the boundary between what people hand in and our code.
//
// Three kinds of failure are never mixed: a bug of ours is an assert, bad input is an Error, and a numerical
// outcome is a typed status in the result.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace gjkdbg {

/// A text as one line: what comes from an input may hold anything, and control characters are written as \xNN.
inline std::string visible(const std::string& text) {
  constexpr const char* digits = "0123456789abcdef";
  std::string line;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (code >= 0x20 && code != 0x7f) line += c;
    else line += {'\\', 'x', digits[code / 16], digits[code % 16]};
  }
  return line;
}

/// What is wrong with an input, and where. `where` is a JSON pointer ("/bodies/0/shape/radius"), a line
/// ("line 12"), or empty when the whole input is meant; `code` is a short kebab-case word that tests and
/// programs can rely on; `message` is one line of English without a final full stop.
class Error : public std::runtime_error {
 public:
  Error(std::string code, const std::string& message, const std::string& where = {})
      : std::runtime_error(visible(message)), code_(std::move(code)), message_(visible(message)), where_(visible(where)) {}

  const std::string& code() const { return code_; }
  const std::string& message() const { return message_; }
  const std::string& where() const { return where_; }

  /// The same error, seen from one level further out: `prefix` is put before the place.
  Error within(const std::string& prefix) const { return Error(code_, message_, prefix + where_); }

  /// The same error, as of a file: its name is put before the place.
  Error in(const std::string& file) const { return Error(code_, message_, file + (where_.empty() ? "" : ": " + where_)); }

  /// "place: message", or the message alone when the place is empty.
  std::string line() const { return where_.empty() ? message_ : where_ + ": " + message_; }

 private:
  std::string code_, message_, where_;
};

}  // namespace gjkdbg
