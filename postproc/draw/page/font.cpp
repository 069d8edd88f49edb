#include "postproc/draw/page/font.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fontconfig/fontconfig.h>
#include <freetype/freetype.h>
#include <fribidi.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <string_view>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/nearest.h"
#include "engine/core/quoted.h"
#include "engine/core/shown_text.h"
#include "postproc/draw/page/picture_warnings.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

using FacePtr = std::unique_ptr<FT_FaceRec_, decltype(&FT_Done_Face)>;
using PatternPtr = std::unique_ptr<FcPattern, decltype(&FcPatternDestroy)>;
using FontSetPtr = std::unique_ptr<FcFontSet, decltype(&FcFontSetDestroy)>;

struct LoadedFont {
  Font font;
  FacePtr face;

  bool has(char32_t letter) const { return FT_Get_Char_Index(face.get(), letter) != 0; }

  bool hasAll(const std::vector<char32_t>& letters) const {
    return std::all_of(letters.begin(), letters.end(), [this](char32_t letter) { return has(letter); });
  }
};

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

std::vector<std::string> familiesOf(FcPattern* pattern) {
  std::vector<std::string> families;
  FcChar8* family = nullptr;
  for (int k = 0; FcPatternGetString(pattern, FC_FAMILY, k, &family) == FcResultMatch; ++k)
    families.emplace_back(reinterpret_cast<const char*>(family));
  return families;
}

std::vector<std::string> installedFamilies() {
  const PatternPtr all(FcPatternBuild(nullptr, FC_SCALABLE, FcTypeBool, FcTrue, nullptr), FcPatternDestroy);
  const std::unique_ptr<FcObjectSet, decltype(&FcObjectSetDestroy)> wanted(
      FcObjectSetBuild(FC_FAMILY, nullptr), FcObjectSetDestroy);
  const FontSetPtr fonts(FcFontList(nullptr, all.get(), wanted.get()), FcFontSetDestroy);
  std::set<std::string> families;
  for (int k = 0; fonts && k < fonts->nfont; ++k)
    for (const std::string& family : familiesOf(fonts->fonts[k])) families.insert(family);
  return {families.begin(), families.end()};
}

/// What fontconfig gives for a pattern; null for nothing.
PatternPtr matchOf(FcPattern& wanted) {
  FcConfigSubstitute(nullptr, &wanted, FcMatchPattern);
  FcDefaultSubstitute(&wanted);
  FcResult result = FcResultNoMatch;
  return {FcFontMatch(nullptr, &wanted, &result), FcPatternDestroy};
}

/// File of a family's regular style; nothing if fontconfig would give another family in its place.
std::optional<std::string> fileOfFamily(const std::string& family) {
  const PatternPtr wanted(FcPatternBuild(nullptr, FC_FAMILY, FcTypeString, family.c_str(), FC_SCALABLE,
                                         FcTypeBool, FcTrue, nullptr),
                          FcPatternDestroy);
  const PatternPtr found = matchOf(*wanted);
  if (!found) return std::nullopt;
  const std::vector<std::string> families = familiesOf(found.get());
  const bool same = std::any_of(families.begin(), families.end(),
                                [&](const std::string& name) { return lower(name) == lower(family); });
  FcChar8* file = nullptr;
  if (!same || FcPatternGetString(found.get(), FC_FILE, 0, &file) != FcResultMatch) return std::nullopt;
  return reinterpret_cast<const char*>(file);
}

std::string fileOf(const std::string& name) {
  std::error_code unreadable;
  if (fs::is_regular_file(name, unreadable)) return name;
  if (isFontFile(name)) throw Error(fmt::format("font: found \"{}\"; there is no such file", name));
  if (const auto file = fileOfFamily(name)) return *file;
  if (name == kDefaultFont)
    throw Error(fmt::format("the font {} is not installed; install the package fonts-dejavu-core", name));
  throw Error(fmt::format(
      "font: found \"{}\"; expected a family that is installed (fc-list tells them) or a font file.{}", name,
      didYouMean(name, installedFamilies())));
}

/// Smallest and greatest height over the line that one of these letters reaches, as parts of the font size.
std::pair<double, double> reachOf(FT_Face face, std::string_view letters) {
  double low = 0.0, high = 0.0;
  for (const char letter : letters) {
    if (FT_Load_Char(face, static_cast<unsigned char>(letter), FT_LOAD_NO_SCALE) != 0) continue;
    const FT_Glyph_Metrics& metrics = face->glyph->metrics;
    high = std::max(high, static_cast<double>(metrics.horiBearingY));
    low = std::min(low, static_cast<double>(metrics.horiBearingY - metrics.height));
  }
  return {low / face->units_per_EM, high / face->units_per_EM};
}

FacePtr openFace(const std::string& file) {
  static FT_Library library = [] {
    FT_Library made = nullptr;
    FT_Init_FreeType(&made);
    return made;
  }();
  FT_Face face = nullptr;
  if (FT_New_Face(library, file.c_str(), 0, &face) != 0)
    throw Error(fmt::format("font: {} is not a font that can be read", file));
  FacePtr owner(face, FT_Done_Face);
  if (!FT_IS_SCALABLE(face))
    throw Error(fmt::format("font: {} has letters of fixed sizes only; expected a scalable font", file));
  return owner;
}

LoadedFont load(const std::string& name) {
  LoadedFont loaded{{}, {nullptr, FT_Done_Face}};
  loaded.font.file = fileOf(name);
  loaded.face = openFace(loaded.font.file);
  loaded.font.family = loaded.face->family_name ? loaded.face->family_name : "";
  loaded.font.capitals = reachOf(loaded.face.get(), "H").second;
  // The letters by which VTK finds the lower edge of a line.
  loaded.font.descent = -reachOf(loaded.face.get(), "_/7Agfy").first;
  return loaded;
}

const LoadedFont& loadedFont(const std::string& name) {
  static std::mutex mutex;
  static std::map<std::string, LoadedFont> fonts;
  const std::lock_guard lock(mutex);
  const auto known = fonts.find(name);
  return known != fonts.end() ? known->second : fonts.emplace(name, load(name)).first->second;
}

/// A letter with the marks over it, or a word of letters that join.
struct Cluster {
  std::string text;
  std::vector<char32_t> letters;
  bool joins = false;
  char32_t script = 0;  ///< of letters that join
};

bool isMark(char32_t letter) {
  return letter >= 0x300 && letter <= 0x36F;
}

/// Letters of the scripts of South and Southeast Asia, which join or change their order, and whose marks stand over and
/// under one another: the first and last of a block of Unicode, and what the blocks of one script share; 0: signs that
/// several scripts have.
struct JoiningBlock {
  char32_t first, last, script;
};
constexpr std::array kJoiningBlocks = std::to_array<JoiningBlock>({
    {0x0900, 0x0963, 0x0900},                            // Devanagari
    {0x0964, 0x0965, 0},                                 // dandas
    {0x0966, 0x097F, 0x0900}, {0x0980, 0x09FF, 0x0980},  // Bengali
    {0x0A00, 0x0A7F, 0x0A00},                            // Gurmukhi
    {0x0A80, 0x0AFF, 0x0A80},                            // Gujarati
    {0x0B00, 0x0B7F, 0x0B00},                            // Oriya
    {0x0B80, 0x0BFF, 0x0B80},                            // Tamil
    {0x0C00, 0x0C7F, 0x0C00},                            // Telugu
    {0x0C80, 0x0CFF, 0x0C80},                            // Kannada
    {0x0D00, 0x0D7F, 0x0D00},                            // Malayalam
    {0x0D80, 0x0DFF, 0x0D80},                            // Sinhala
    {0x0E00, 0x0E7F, 0x0E00},                            // Thai
    {0x0E80, 0x0EFF, 0x0E80},                            // Lao
    {0x0F00, 0x0FFF, 0x0F00},                            // Tibetan
    {0x1000, 0x109F, 0x1000},                            // Burmese
    {0x1700, 0x171F, 0x1700},                            // Tagalog
    {0x1720, 0x173F, 0x1720},                            // Hanunoo
    {0x1740, 0x175F, 0x1740},                            // Buhid
    {0x1760, 0x177F, 0x1760},                            // Tagbanwa
    {0x1780, 0x17FF, 0x1780},                            // Khmer
    {0x1900, 0x194F, 0x1900},                            // Limbu
    {0x1A00, 0x1A1F, 0x1A00},                            // Buginese
    {0x1A20, 0x1AAF, 0x1A20},                            // Tai Tham
    {0x1B00, 0x1B7F, 0x1B00},                            // Balinese
    {0x1B80, 0x1BBF, 0x1B80},                            // Sundanese
    {0x1BC0, 0x1BFF, 0x1BC0},                            // Batak
    {0x1C00, 0x1C4F, 0x1C00},                            // Lepcha
    {0x1CD0, 0x1CFF, 0},                                 // Vedic signs
    {0xA800, 0xA82F, 0xA800},                            // Syloti Nagri
    {0xA880, 0xA8DF, 0xA880},                            // Saurashtra
    {0xA8E0, 0xA8FF, 0x0900},                            // Devanagari
    {0xA930, 0xA95F, 0xA930},                            // Rejang
    {0xA980, 0xA9DF, 0xA980},                            // Javanese
    {0xA9E0, 0xA9FF, 0x1000},                            // Burmese
    {0xAA00, 0xAA5F, 0xAA00},                            // Cham
    {0xAA60, 0xAA7F, 0x1000},                            // Burmese
    {0xAA80, 0xAADF, 0xAA80},                            // Tai Viet
    {0xAAE0, 0xAAFF, 0xABC0},                            // Meetei
    {0xABC0, 0xABFF, 0xABC0},
});

/// Null for letters of other scripts.
const JoiningBlock* joiningBlock(char32_t letter) {
  const auto* block = std::ranges::lower_bound(kJoiningBlocks, letter, {}, &JoiningBlock::last);
  return block != kJoiningBlocks.end() && block->first <= letter ? block : nullptr;
}

/// Within words of such scripts: tells letters to join, or not to.
bool isJoiner(char32_t letter) {
  return letter == 0x200C || letter == 0x200D;
}

/// Of the scripts that are written from right to left: Hebrew to Mandaic, and the forms of their letters.
bool isFromRightToLeft(char32_t letter) {
  return (letter >= 0x590 && letter <= 0x8FF) || (letter >= 0xFB1D && letter <= 0xFDFF) ||
         (letter >= 0xFE70 && letter <= 0xFEFC);
}

/// Stand for bytes that are no UTF-8, and for letters that no font has.
constexpr const char* kReplacement = "\xEF\xBF\xBD";
constexpr const char* kBox = "□";

/// The clusters of a text in UTF-8.
std::vector<Cluster> clustersOf(const std::string& text) {
  std::vector<Cluster> clusters;
  for (std::size_t at = 0; at < text.size();) {
    const auto [letter, length] = letterAt(text, at);
    const JoiningBlock* block = joiningBlock(letter);
    const bool joins = block != nullptr;
    const char32_t script = joins ? block->script : 0;
    const auto goesOn = [&](const Cluster& word) {
      const bool isSameScript = joins && (script == 0 || word.script == 0 || script == word.script);
      return isMark(letter) || (word.joins && (isSameScript || isJoiner(letter)));
    };
    if (clusters.empty() || !goesOn(clusters.back())) clusters.push_back({{}, {}, joins});
    if (script != 0) clusters.back().script = script;
    const bool blank = letter == '\n' || letter == '\t';
    clusters.back().text += blank ? " " : length > 0 ? text.substr(at, length) : kReplacement;
    clusters.back().letters.push_back(blank ? U' ' : letter);
    at += std::max<std::size_t>(1, length);
  }
  return clusters;
}

/// A text as it is set from left to right: letters in the order and the forms in which they are seen.
struct SeenText {
  std::string text;
  std::vector<std::string> meant;  ///< of each letter what was written
};

std::string utf8(std::span<const FriBidiChar> letters) {
  std::string bytes(4 * letters.size() + 1, '\0');
  bytes.resize(static_cast<std::size_t>(fribidi_unicode_to_charset(
      FRIBIDI_CHAR_SET_UTF8, letters.data(), static_cast<FriBidiStrIndex>(letters.size()), bytes.data())));
  return bytes;
}

/// Leaves out letters that only tell the direction, and all joiners but those of letters that join.
SeenText inVisualOrder(const std::string& text) {
  constexpr FriBidiChar kLam = 0x644;
  const auto isLamAlef = [](FriBidiChar letter) { return letter >= 0xFEF5 && letter <= 0xFEFC; };
  std::vector<FriBidiChar> written;
  for (const Cluster& cluster : clustersOf(text))
    written.insert(written.end(), cluster.letters.begin(), cluster.letters.end());
  const std::size_t count = written.size();
  std::vector<FriBidiChar> seen(count + 1);
  std::vector<FriBidiStrIndex> places(count);
  FriBidiParType direction = FRIBIDI_PAR_ON;
  if (fribidi_log2vis(written.data(), static_cast<FriBidiStrIndex>(count), &direction, seen.data(), nullptr,
                      places.data(), nullptr) == 0)
    return {text, {}};
  SeenText result;
  for (std::size_t k = 0; k < count; ++k) {
    FriBidiChar letter = seen[k];
    const bool joins = isJoiner(letter) && k > 0 && joiningBlock(seen[k - 1]) != nullptr;
    if (!joins && fribidi_remove_bidi_marks(&letter, 1, nullptr, nullptr, nullptr) == 0) continue;
    result.text += utf8({&seen[k], 1});
    const auto place = static_cast<std::size_t>(places[k]);
    std::vector<FriBidiChar> meant{written[place]};
    if (isLamAlef(letter) && !isLamAlef(meant.front()))
      meant.insert(meant.begin(), kLam);  // one letter for two
    result.meant.push_back(utf8(meant));
  }
  return result;
}

/// The file of an installed font that has a letter; nothing if there is none.
std::optional<std::string> fileWithLetter(char32_t letter) {
  const std::unique_ptr<FcCharSet, decltype(&FcCharSetDestroy)> letters(FcCharSetCreate(), FcCharSetDestroy);
  FcCharSetAddChar(letters.get(), letter);
  const PatternPtr wanted(FcPatternBuild(nullptr, FC_CHARSET, FcTypeCharSet, letters.get(), FC_SCALABLE,
                                         FcTypeBool, FcTrue, nullptr),
                          FcPatternDestroy);
  const PatternPtr found = matchOf(*wanted);
  FcChar8* file = nullptr;
  if (!found || FcPatternGetString(found.get(), FC_FILE, 0, &file) != FcResultMatch) return std::nullopt;
  return reinterpret_cast<const char*>(file);
}

/// Another font that has a letter, or null. Fonts that cannot be read are as if they were not there.
const LoadedFont* fontWithLetter(char32_t letter) {
  static std::mutex mutex;
  static std::map<char32_t, const LoadedFont*> known;
  const std::lock_guard lock(mutex);
  const auto [entry, isNew] = known.try_emplace(letter, nullptr);
  if (!isNew) return entry->second;
  const std::optional<std::string> file = letter > U' ' ? fileWithLetter(letter) : std::nullopt;
  try {
    const LoadedFont* font = file ? &loadedFont(*file) : nullptr;
    if (font != nullptr && font->has(letter)) entry->second = font;
  } catch (const Error&) {
  }
  return entry->second;
}

/// The glyphs of letters that join, and their font.
struct ShapedWord {
  const LoadedFont* font = nullptr;  ///< null: none has all of them
  ShapedText text;
};

/// In the font of this name, the default one, or another that has all letters.
ShapedWord shapedWord(const Cluster& word, const LoadedFont& wanted, const LoadedFont& substitute) {
  const auto set = [&](const LoadedFont* font) -> ShapedWord {
    if (font == nullptr) return {};
    ShapedText text = shapedText(word.text, font->font.file);
    return text.glyphs.empty() ? ShapedWord{} : ShapedWord{font, std::move(text)};
  };
  ShapedWord found = set(&wanted);
  if (found.font == nullptr) found = set(&substitute);
  if (found.font == nullptr) found = set(fontWithLetter(word.letters.front()));
  return found;
}

/// The font of this name, the default one, or another that has the letter; null: none has it.
const LoadedFont* fontFor(char32_t letter, const LoadedFont& wanted, const LoadedFont& substitute) {
  return wanted.has(letter) ? &wanted : substitute.has(letter) ? &substitute : fontWithLetter(letter);
}

}  // namespace

bool hasLettersFromRightToLeft(const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const auto [letter, length] = letterAt(text, at);
    if (isFromRightToLeft(letter)) return true;
    at += std::max<std::size_t>(1, length);
  }
  return false;
}

bool isFontFile(const std::string& name) {
  const std::string ending = lower(fs::path(name).extension().string());
  return name.find('/') != std::string::npos || ending == ".ttf" || ending == ".otf" || ending == ".ttc" ||
         ending == ".pfb";
}

const Font& fontNamed(const std::string& name) {
  return loadedFont(name).font;
}

std::vector<FontPiece> fontPieces(const std::string& text, const std::string& name) {
  const LoadedFont& wanted = loadedFont(name);
  const LoadedFont& substitute = loadedFont(kDefaultFont);
  const bool isTurned = hasLettersFromRightToLeft(text);
  const SeenText seen = isTurned ? inVisualOrder(text) : SeenText{text, {}};
  std::vector<FontPiece> pieces;
  std::size_t numSeen = 0;  // letters
  const auto add = [&](const std::string& part, const LoadedFont& in, const std::string& letters,
                       std::size_t numLetters) {
    if (pieces.empty() || pieces.back().font != &in.font || isShaped(pieces.back()))
      pieces.push_back({"", &in.font, ""});
    pieces.back().text += part;
    if (!isTurned) pieces.back().letters += letters;
    for (; numLetters > 0; --numLetters, ++numSeen)
      if (numSeen < seen.meant.size()) pieces.back().meant.push_back(seen.meant[numSeen]);
  };
  for (const Cluster& cluster : clustersOf(seen.text)) {
    ShapedWord word;
    if (cluster.joins) word = shapedWord(cluster, wanted, substitute);
    if (word.font != nullptr) {
      pieces.push_back({cluster.text, &word.font->font, isTurned ? "" : cluster.text, std::move(word.text)});
      numSeen += cluster.letters.size();
    } else if (wanted.hasAll(cluster.letters)) {
      add(cluster.text, wanted, cluster.text, cluster.letters.size());
    } else if (substitute.hasAll(cluster.letters)) {
      add(cluster.text, substitute, cluster.text, cluster.letters.size());
    } else {  // letter by letter
      std::size_t at = 0;
      for (const char32_t letter : cluster.letters) {
        const std::size_t length = letterAt(cluster.text, at).length;
        const std::string written = cluster.text.substr(at, length);
        const LoadedFont* font = fontFor(letter, wanted, substitute);
        add(font != nullptr ? written : kBox, font != nullptr ? *font : substitute, written, 1);
        at += length;
      }
    }
  }
  if (isTurned && !pieces.empty())
    for (const Cluster& cluster : clustersOf(text)) pieces.front().letters += cluster.text;
  return pieces;
}

void noteDrawnText(const std::string& text, const std::string& name) {
  const LoadedFont& wanted = loadedFont(name);
  const LoadedFont& substitute = loadedFont(kDefaultFont);
  std::set<char32_t> missing;
  bool isTorn = false;
  for (const Cluster& cluster : clustersOf(text)) {
    const bool isWhole = cluster.joins && shapedWord(cluster, wanted, substitute).font != nullptr;
    isTorn = isTorn || (cluster.joins && !isWhole);
    if (isWhole) continue;
    for (const char32_t letter : cluster.letters)
      if (fontFor(letter, wanted, substitute) == nullptr) missing.insert(letter);
  }
  if (missing.empty()) {
    if (isTorn)
      noteWarning(fmt::format(
          "{} has letters of a script that join beside one another, which are set one by one: no font has "
          "all of them",
          quoted(text)));
    return;
  }
  std::vector<std::string> codes;
  for (const char32_t letter : missing)
    codes.push_back(fmt::format("U+{:04X}", static_cast<std::uint32_t>(letter)));
  const std::string fonts =
      name == kDefaultFont
          ? fmt::format("neither the font {} nor another one has", name)
          : fmt::format("neither the font {} nor {} nor another one has", name, kDefaultFont);
  noteWarning(fmt::format("{} {}; {} is drawn with a box for {}", fonts, fmt::join(codes, ", "), quoted(text),
                          codes.size() == 1 ? "it" : "each"));
}

}  // namespace burnish
