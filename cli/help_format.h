#pragma once
#include <memory>

namespace CLI {
class FormatterBase;
}

namespace burnish {

/// How help is laid out: names at the left, what they mean at the right. On a terminal the lines end where it ends; in a file or a
/// pipe each option is one line.
std::shared_ptr<CLI::FormatterBase> helpFormat();

}  // namespace burnish
