#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/failure.h"

namespace plat::similarity::detail {

using Bytes = std::vector<std::byte>;

/// Puts values one behind the other, as they are in memory.
class Packer {
 public:
  template <class T>
    requires std::is_trivially_copyable_v<T>
  void add(const T& value) {
    add_all(std::span(&value, 1));
  }
  template <class T>
  void add_all(std::span<const T> values) {
    const auto bytes = std::as_bytes(values);
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }
  void add_text(std::string_view text) {
    add(static_cast<std::uint32_t>(text.size()));
    add_all(std::span(text));
  }
  [[nodiscard]] const Bytes& bytes() const { return bytes_; }

 private:
  Bytes bytes_;
};

/// Takes them out again; never reads beyond the end.
class Unpacker {
 public:
  Unpacker(std::span<const std::byte> bytes, std::string file)
      : bytes_(bytes), file_(std::move(file)) {}

  template <class T>
  T take() {
    T value;
    const auto bytes = take_bytes(1, sizeof(T));
    std::memcpy(&value, bytes.data(), sizeof(T));
    return value;
  }
  template <class T>
  std::vector<T> take_all(std::uint64_t count) {
    const auto bytes = take_bytes(count, sizeof(T));
    std::vector<T> values(count);
    if (count > 0) std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
  }
  std::string take_text() {
    const auto size = take<std::uint32_t>();
    const auto bytes = take_bytes(size, 1);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }
  [[nodiscard]] std::uint64_t left() const { return bytes_.size(); }
  [[noreturn]] void refuse(std::string_view why) const {
    throw InputError(
        fmt::format("{}: damaged similarity matrix: {}; compute it again", file_, why));
  }

 private:
  std::span<const std::byte> take_bytes(std::uint64_t count, std::uint64_t size) {
    if (count > bytes_.size() / size) refuse("it is cut off");
    const auto taken = bytes_.first(count * size);
    bytes_ = bytes_.subspan(count * size);
    return taken;
  }

  std::span<const std::byte> bytes_;
  std::string file_;
};

}  // namespace plat::similarity::detail
