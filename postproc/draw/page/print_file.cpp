#include "postproc/draw/page/print_file.h"

#include <fmt/format.h>

#include <cstddef>
#include <span>

#include "engine/core/atomic_file.h"
#include "engine/core/error.h"

namespace burnish {

bool isPrintFile(const std::filesystem::path& file) {
  return file.extension() == ".pdf" || file.extension() == ".svg";
}

void writePrint(const PrintPage& page, const std::filesystem::path& file) {
  if (!isPrintFile(file))
    throw Error(fmt::format("\"{}\": expected the name of a page that ends in .pdf or .svg", file.string()));
  const std::string text = file.extension() == ".pdf" ? pdfText(page) : svgText(page);
  writeFileAtomically(file, std::as_bytes(std::span(text)));
}

}  // namespace burnish
