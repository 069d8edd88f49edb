#pragma once
#include <string>
#include <utility>

#include "engine/core/error.h"

namespace burnish::inline core {

/// What is wrong with a key of a mapping, such as the tool that a file is read for: who knows the path of the mapping knows that of
/// the key.
class KeyError : public Error {
 public:
  KeyError(std::string key, const std::string& message) : Error(message), key_(std::move(key)) {}

  const std::string& key() const { return key_; }

 private:
  std::string key_;
};

}  // namespace burnish::inline core
