#pragma once
#include <functional>
#include <string>

#include "engine/core/error.h"

namespace burnish {

/// What the error of an action says; empty if there is none.
inline std::string messageOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace burnish
