#pragma once

#include <fmt/format.h>

#include <concepts>
#include <optional>
#include <string>
#include <string_view>

namespace plat::harness {

/// A CSV table being put together: "," between fields, fields quoted only where they must be,
/// numbers as the shortest text that reads back exactly, nothing for a value that is absent.
class CsvTable {
 public:
  explicit CsvTable(std::string_view header) : text_(header) { text_ += '\n'; }

  template <class... Fields>
  void add_row(const Fields&... fields) {
    const std::size_t start = text_.size();
    ((add_field(fields), text_ += ','), ...);
    if (text_.size() > start) text_.back() = '\n';
  }

  /// Fields already joined by commas.
  void add_raw_row(std::string_view row) {
    text_ += row;
    text_ += '\n';
  }

  [[nodiscard]] const std::string& text() const { return text_; }

  static std::string quoted(std::string_view field) {
    if (field.find_first_of(",\"\n\r") == std::string_view::npos) return std::string(field);
    std::string out = "\"";
    for (const char c : field) {
      if (c == '"') out += '"';
      out += c;
    }
    return out + '"';
  }

 private:
  void add_field(std::string_view field) { text_ += quoted(field); }
  void add_field(const std::string& field) { text_ += quoted(field); }
  void add_field(const char* field) { text_ += quoted(field); }
  template <class Number>
    requires std::integral<Number> || std::floating_point<Number>
  void add_field(Number number) {
    fmt::format_to(std::back_inserter(text_), "{}", number);
  }
  template <class Value>
  void add_field(const std::optional<Value>& value) {
    if (value) add_field(*value);
  }

  std::string text_;
};

}  // namespace plat::harness
