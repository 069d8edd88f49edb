#pragma once
#include <string>

/// Manual pages, in the language that man, groff and mandoc read: man(7).
namespace burnish {

/// Text that is shown as it is: what roff would take for its own is escaped.
std::string roffText(const std::string& text);
/// What is to be typed as it stands.
std::string roffBold(const std::string& text);
/// What is to be replaced.
std::string roffItalic(const std::string& text);

/// A page that is written from its head to its end. Texts of lines are made by the functions above.
class RoffPage {
 public:
  /// name: of the page, such as burnish-run; source: at its foot.
  RoffPage(const std::string& name, int section, const std::string& source, const std::string& about);

  void section(const std::string& title);
  void subsection(const std::string& title);
  void paragraph(const std::string& line);
  /// What a term means, in a list of such.
  void item(const std::string& term, const std::string& line);
  /// Lines that are set as they are.
  void example(const std::string& text);
  /// A list in the item before it.
  void beginList();
  void endList();

  std::string text() && { return std::move(out_); }

 private:
  void line(const std::string& text);

  std::string out_;
  bool isFresh_ = true;  ///< a heading stands before: a paragraph begins by itself
};

/// Lists, tables of two columns, headings and paragraphs of Markdown as parts of a page. A code that begins an entry of a
/// list is its term; links lead to headings below.
void addMarkdown(RoffPage& page, const std::string& markdown);

}  // namespace burnish
