#include "postproc/text/roff.h"

#include <fmt/format.h>
#include <md4c.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <string_view>
#include <vector>

namespace burnish {
namespace {

/// One letter of more than a byte; at: of its first, moved to its last.
std::uint32_t letterAt(const std::string& text, std::size_t& at) {
  const auto first = static_cast<unsigned char>(text[at]);
  const int more = first >= 0xF0 ? 3 : first >= 0xE0 ? 2 : 1;
  std::uint32_t letter = first & (0x3FU >> static_cast<unsigned>(more));
  for (int k = 0; k < more && at + 1 < text.size(); ++k)
    letter = letter << 6U | (static_cast<unsigned char>(text[++at]) & 0x3FU);
  return letter;
}

std::string inCapitals(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

/// In quotes, as the argument of a request.
std::string argument(const std::string& text) {
  std::string escaped;
  for (const char letter : roffText(text)) escaped += letter == '"' ? "\\(dq" : std::string(1, letter);
  return '"' + escaped + '"';
}

/// Puts what md4c finds into a page.
class MarkdownWriter {
 public:
  explicit MarkdownWriter(RoffPage& page) : page_(page) {}

  void enter(MD_BLOCKTYPE type) {
    if (type == MD_BLOCK_UL) {
      flush();
      if (depth_++ > 0) page_.beginList();
    }
    if (type == MD_BLOCK_LI || type == MD_BLOCK_TR) {
      term_.clear();
      awaitsTerm_ = true;
    }
    if (type == MD_BLOCK_THEAD) skips_ = true;
    isTable_ = isTable_ || type == MD_BLOCK_TABLE;
  }

  void leave(MD_BLOCKTYPE type) {
    if (type == MD_BLOCK_THEAD) skips_ = false;
    isTable_ = isTable_ && type != MD_BLOCK_TABLE;
    if (type == MD_BLOCK_TD && awaitsTerm_ && !skips_) takeTerm();
    if (type == MD_BLOCK_LI || type == MD_BLOCK_TR) flush();
    if (type == MD_BLOCK_UL && --depth_ > 0) page_.endList();
    if (type == MD_BLOCK_P && depth_ == 0) flush();
    if (type == MD_BLOCK_H) {
      if (level_ < 3)
        page_.section(plain_);
      else
        page_.subsection(plain_);
      reset();
    }
  }

  void heading(unsigned level) { level_ = level; }

  void enterSpan(MD_SPANTYPE type) { isCode_ = isCode_ || type == MD_SPAN_CODE; }

  void leaveSpan(MD_SPANTYPE type) {
    if (type == MD_SPAN_A) add(" below", " below");
    if (type != MD_SPAN_CODE) return;
    isCode_ = false;
    if (awaitsTerm_ && depth_ > 0 && plain_.empty()) takeTerm();
  }

  void text(MD_TEXTTYPE type, std::string text) {
    if (skips_) return;
    if (isTable_)  // where a code may not hold a bar of its own
      for (std::size_t at = 0; (at = text.find("\\|", at)) != std::string::npos; ++at) text.erase(at, 1);
    if (type == MD_TEXT_SOFTBR || type == MD_TEXT_BR) return add(" ", " ");
    if (isCode_ && !(awaitsTerm_ && depth_ > 0 && plain_.empty())) return add(text, roffBold(text));
    if (isCode_) {
      line_ += roffBold(text);
      return;
    }
    const bool follows = !term_.empty() && plain_.empty() && text.starts_with(": ");
    const std::string shown = follows ? text.substr(2) : text;
    add(shown, roffText(shown));
  }

 private:
  void add(const std::string& plain, const std::string& roff) {
    plain_ += plain;
    line_ += roff;
  }

  void takeTerm() {
    term_ = line_;
    awaitsTerm_ = false;
    line_.clear();
    plain_.clear();
  }

  void reset() {
    line_.clear();
    plain_.clear();
    term_.clear();
    awaitsTerm_ = false;
  }

  void flush() {
    if (!term_.empty())
      page_.item(term_, line_);
    else if (!line_.empty())
      page_.paragraph(line_);
    reset();
  }

  RoffPage& page_;
  std::string line_, plain_, term_;
  int depth_ = 0;
  unsigned level_ = 2;
  bool isCode_ = false, awaitsTerm_ = false, skips_ = false, isTable_ = false;
};

MarkdownWriter& writer(void* data) {
  return *static_cast<MarkdownWriter*>(data);
}

}  // namespace

std::string roffText(const std::string& text) {
  std::string escaped;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char letter = text[at];
    if (static_cast<unsigned char>(letter) >= 0x80)
      escaped += fmt::format("\\[u{:04X}]", letterAt(text, at));
    else if (letter == '\\')
      escaped += "\\e";
    else if (letter == '-')  // a hyphen that can be copied into a shell
      escaped += "\\-";
    else if (letter == '\'')
      escaped += "\\(aq";
    else if (letter == '`')
      escaped += "\\(ga";
    else if (letter == '^')
      escaped += "\\(ha";
    else if (letter == '~')
      escaped += "\\(ti";
    else
      escaped += letter;
  }
  return escaped;
}

std::string roffBold(const std::string& text) {
  return "\\fB" + roffText(text) + "\\fR";
}

std::string roffItalic(const std::string& text) {
  return "\\fI" + roffText(text) + "\\fR";
}

RoffPage::RoffPage(const std::string& name, int section, const std::string& source, const std::string& about)
    // Without a date: equal programs write equal pages.
    : out_(fmt::format(".TH {} {} \"\" {} {}\n.nh\n.ad l\n", argument(inCapitals(name)), section,
                       argument(source), argument("Manual of burnish"))) {
  this->section("NAME");
  line(roffText(name) + " \\- " + roffText(about));
}

void RoffPage::section(const std::string& title) {
  out_ += ".SH " + argument(inCapitals(title)) + "\n";
  isFresh_ = true;
}

void RoffPage::subsection(const std::string& title) {
  out_ += ".SS " + argument(title) + "\n";
  isFresh_ = true;
}

void RoffPage::paragraph(const std::string& text) {
  if (!isFresh_) out_ += ".PP\n";
  line(text);
}

void RoffPage::item(const std::string& term, const std::string& text) {
  out_ += ".TP\n" + term + "\n";
  line(text);
}

void RoffPage::example(const std::string& text) {
  out_ += ".PP\n.nf\n.RS 4\n";
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    out_ += roffText(text.substr(begin, end - begin)) + "\n";
    begin = end + 1;
  }
  out_ += ".RE\n.fi\n";
}

void RoffPage::beginList() {
  out_ += ".RS\n";
}

void RoffPage::endList() {
  out_ += ".RE\n";
}

void RoffPage::line(const std::string& text) {
  constexpr std::size_t kMost = 78;
  isFresh_ = false;
  for (std::size_t begin = 0; begin < text.size();) {
    std::size_t end = text.size();
    if (end - begin > kMost) {  // at the last blank that leaves room, or the first one
      end = text.rfind(' ', begin + kMost);
      if (end == std::string::npos || end <= begin) end = std::min(text.find(' ', begin), text.size());
    }
    // A point in front would begin a request.
    out_ += (text[begin] == '.' ? "\\&" : "") + text.substr(begin, end - begin) + "\n";
    begin = text.find_first_not_of(' ', end);
  }
}

void addMarkdown(RoffPage& page, const std::string& markdown) {
  MarkdownWriter state(page);
  MD_PARSER parser{};
  parser.flags = MD_FLAG_TABLES | MD_FLAG_NOHTML;
  parser.enter_block = [](MD_BLOCKTYPE type, void* detail, void* data) {
    if (type == MD_BLOCK_H) writer(data).heading(static_cast<MD_BLOCK_H_DETAIL*>(detail)->level);
    writer(data).enter(type);
    return 0;
  };
  parser.leave_block = [](MD_BLOCKTYPE type, void*, void* data) {
    writer(data).leave(type);
    return 0;
  };
  parser.enter_span = [](MD_SPANTYPE type, void*, void* data) {
    writer(data).enterSpan(type);
    return 0;
  };
  parser.leave_span = [](MD_SPANTYPE type, void*, void* data) {
    writer(data).leaveSpan(type);
    return 0;
  };
  parser.text = [](MD_TEXTTYPE type, const MD_CHAR* text, MD_SIZE size, void* data) {
    writer(data).text(type, std::string(text, size));
    return 0;
  };
  md_parse(markdown.data(), static_cast<MD_SIZE>(markdown.size()), &parser, &state);
}

}  // namespace burnish
