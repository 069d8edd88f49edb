#pragma once
#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "tests/engine/scene/scene_samples.h"

/// Mistakes in scenes, as parameters of tests.
namespace burnish::samples {

/// "test.yaml:LINE:COLUMN" of a position in a text.
inline std::string placeIn(const std::string& text, std::size_t position) {
  std::size_t line = 1, lineBegin = 0;
  for (std::size_t i = 0; i < position; ++i)
    if (text[i] == '\n') {
      ++line;
      lineBegin = i + 1;
    }
  return "test.yaml:" + std::to_string(line) + ":" + std::to_string(position - lineBegin + 1);
}

/// A mistake made in a good scene: `from` becomes `to`, and the error stands at `at`, within `to` if it is
/// there.
struct Mistake {
  const char* name;
  const std::string* scene;
  std::string from, to, at;
  std::string key;
  std::string message;  ///< what was found and what is allowed; the beginning of it is enough
};

inline void PrintTo(const Mistake& mistake, std::ostream* out) {
  *out << mistake.name;
}

inline std::string nameOf(const testing::TestParamInfo<Mistake>& test) {
  return test.param.name;
}

/// What a reader says of the scene with the mistake: one line that begins with place, key and message.
template <class ErrorOf>
void expectReported(const Mistake& m, const ErrorOf& errorOfScene) {
  const std::string yaml = replaced(*m.scene, m.from, m.to);
  const bool within = m.to.find(m.at) != std::string::npos;
  const std::string place = placeIn(yaml, within ? m.scene->find(m.from) + m.to.find(m.at) : yaml.find(m.at));
  const std::string expected = place + ": " + m.key + ": " + m.message;
  const std::string message = errorOfScene(yaml);
  EXPECT_EQ(message.substr(0, expected.size()), expected) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << "only one thing is wrong:\n" << message;
}

}  // namespace burnish::samples
