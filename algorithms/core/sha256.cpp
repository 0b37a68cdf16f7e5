#include "core/sha256.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include "core/failure.h"

namespace plat {

struct Sha256::State {
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context{EVP_MD_CTX_new(),
                                                                  &EVP_MD_CTX_free};
};

Sha256::Sha256() : state_(std::make_unique<State>()) {
  expects(EVP_DigestInit_ex(state_->context.get(), EVP_sha256(), nullptr) == 1,
          "SHA-256 is available");
}

Sha256::~Sha256() = default;

void Sha256::add(std::span<const std::byte> bytes) {
  expects(EVP_DigestUpdate(state_->context.get(), bytes.data(), bytes.size()) == 1,
          "nothing is added after digest()");
}

Sha256Digest Sha256::digest() {
  std::array<unsigned char, EVP_MAX_MD_SIZE> value{};
  unsigned int size = 0;
  expects(EVP_DigestFinal_ex(state_->context.get(), value.data(), &size) == 1 && size == 32,
          "a digest has 32 bytes");
  Sha256Digest digest;
  for (std::size_t i = 0; i < digest.size(); ++i) digest[i] = std::byte{value[i]};
  return digest;
}

std::string to_hex(const Sha256Digest& digest) {
  std::string hex;
  for (const std::byte b : digest) hex += fmt::format("{:02x}", std::to_integer<int>(b));
  return hex;
}

}  // namespace plat
