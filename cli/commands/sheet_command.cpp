#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/commands/picture_options.h"
#include "cli/commands/picture_source.h"
#include "cli/jobs/child_process.h"
#include "cli/output_target.h"
#include "engine/core/error.h"
#include "postproc/draw/page/picture_size.h"
#include "postproc/draw/page/print_file.h"
#include "postproc/draw/page/sheet.h"
#include "postproc/foreign/foreign_file.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

/// The options of a panel that is drawn, which leaves its title to the caption.
struct DrawnPanelOptions : PictureOptions {};

template <class Visitor>
void describe(Visitor& v, DrawnPanelOptions& s) {
  describeParts(v, s);
  describeView(v, s);
  describeLook(v, s);
  describeTextSize(v, s);
}

/// The size of such panels, in a sheet whose width is not given.
struct PanelSize : PictureOptions {
  PanelSize() { size = {960, 540}; }
};

template <class Visitor>
void describe(Visitor& v, PanelSize& s) {
  describeSize(v, s, "panel_size");
}

struct SheetArguments {
  std::vector<fs::path> inputs;
  fs::path sheet;
  int columns = 0;  ///< 0: as many as rows
  std::vector<std::string> captions;
  int width = 0;             ///< 0: the usual one
  PictureArguments picture;  ///< of results
};

constexpr int kUsualWidth = 1600;  // of a sheet of pictures

/// Whether a panel is to be drawn of it; else it is a picture.
bool isResult(const fs::path& input) {
  std::error_code status;
  return fs::is_directory(input, status) || input.extension() == ".h5" || !foreignKind(input).empty();
}

/// What is laid out: pictures that there are, and frames of results that are drawn with one window and one range of colours.
class Panels {
 public:
  explicit Panels(const SheetArguments& arguments) : arguments_(arguments) {
    perInput_.reserve(arguments.inputs.size());  // sources look at them
    for (const fs::path& input : arguments.inputs) {
      if (!isResult(input)) {
        panels_.push_back({input, {}, 0});
        continue;
      }
      perInput_.push_back(arguments.picture);
      perInput_.back().result = input;
      const PictureSource source = pictureSource(perInput_.back());
      const std::vector<int> frames = frameIndices(arguments.picture.frame, source.times);
      sources_.push_back({source.single(frames.front()), static_cast<int>(source.times.size())});
      for (const int frame : frames) panels_.push_back({input, sources_.size() - 1, frame});
    }
  }

  std::size_t count() const { return panels_.size(); }
  bool haveResults() const { return !sources_.empty(); }

  /// Gives what is drawn the size and what it shares. panel: width and height in pixels.
  void share(const std::array<int, 2>& panel) {
    if (sources_.empty()) return;
    ContourOptions& shared = sources_.front().single.options;
    for (const Source& source : sources_)
      if (source.single.options.field != shared.field)
        throw Error(fmt::format("--field: panels show {} and {}; expected one field for all of them",
                                shared.field, source.single.options.field));
    std::vector<Looked> looked;
    shareView(shared, framesInRange(looked), framesInWindow(looked), [&](int k, bool inRange, bool inWindow) {
      const Looked& at = looked[static_cast<std::size_t>(k)];
      const PictureSource::Single& single = sources_[at.source].single;
      ContourOptions own = single.options;
      own.eye = shared.eye;
      return single.look(at.frame, own, inRange, inWindow);
    });
    for (const Source& source : sources_) {
      const PictureSource::Single& single = source.single;
      shared.room->doubt = shared.room->doubt || !single.options.doubt.empty();
      shared.room->note = shared.room->note || (shared.range && !single.clipNote.empty());
    }
    for (Source& source : sources_) {
      ContourOptions& options = source.single.options;
      options.room = shared.room;
      options.range = shared.range;
      options.window = shared.window;
      options.eye = shared.eye;
      options.largest = shared.largest;
      if (shared.range) options.clip.reset();
      if (shared.range) options.note = source.single.clipNote;
      options.size = panel;
      if (!options.textSize) options.textSize = options.theme.textSize * sheetTextSize(panel[0]);
      options.title = "";
      options.pointsPerPixel = sheetPointsPerPixel(panel[0]);
    }
  }

  std::vector<SheetPanel> pictures() const {
    std::vector<SheetPanel> drawn;
    for (std::size_t k = 0; k < panels_.size(); ++k) {
      const Panel& panel = panels_[k];
      if (panel.source)
        drawn.push_back({single(panel).image(panel.frame, single(panel).options).picture, caption(k)});
      else
        drawn.push_back({panel.input, caption(k)});
    }
    return drawn;
  }

  std::vector<PrintPanel> pages() const {
    std::vector<PrintPanel> drawn;
    for (std::size_t k = 0; k < panels_.size(); ++k) {
      const Panel& panel = panels_[k];
      drawn.push_back(
          {panel.source ? single(panel).page(panel.frame, single(panel).options) : pageOfPicture(panel.input),
           caption(k)});
    }
    return drawn;
  }

 private:
  struct Panel {
    fs::path input;
    std::optional<std::size_t> source;  ///< none of a picture
    int frame = 0;
  };

  struct Source {
    PictureSource::Single single;
    int numFrames;
  };

  struct Looked {
    std::size_t source;
    int frame;
  };

  const PictureSource::Single& single(const Panel& panel) const { return sources_[*panel.source].single; }

  std::string caption(std::size_t number) const {
    return arguments_.captions.empty() ? "" : arguments_.captions[number];
  }

  /// Numbers of the frames whose values the colours go through together, which are added to those that are looked at.
  std::vector<int> framesInRange(std::vector<Looked>& looked) const {
    const std::string& range = arguments_.picture.range;
    std::vector<Looked> wanted;
    if (range == "run") {
      for (std::size_t s = 0; s < sources_.size(); ++s)
        for (int frame = 0; frame < sources_[s].numFrames; ++frame) wanted.push_back({s, frame});
    } else if (range == "auto") {
      wanted = drawnFrames();
    }
    return added(wanted, looked);
  }

  std::vector<int> framesInWindow(std::vector<Looked>& looked) const { return added(drawnFrames(), looked); }

  std::vector<Looked> drawnFrames() const {
    std::vector<Looked> frames;
    for (const Panel& panel : panels_)
      if (panel.source) frames.push_back({*panel.source, panel.frame});
    return frames;
  }

  static std::vector<int> added(const std::vector<Looked>& wanted, std::vector<Looked>& looked) {
    std::vector<int> numbers;
    for (const Looked& frame : wanted) {
      const auto known = std::find_if(looked.begin(), looked.end(), [&](const Looked& other) {
        return other.source == frame.source && other.frame == frame.frame;
      });
      numbers.push_back(static_cast<int>(known - looked.begin()));
      if (known == looked.end()) looked.push_back(frame);
    }
    return numbers;
  }

  const SheetArguments& arguments_;
  std::vector<PictureArguments> perInput_;
  std::vector<Source> sources_;
  std::vector<Panel> panels_;
};

/// Throws `Error` for other endings than those of pictures, and for options that are those of the others.
void checkOutput(const SheetArguments& arguments) {
  if (isPrintFile(arguments.sheet)) return;
  if (arguments.sheet.extension() != ".png" && !isStandardOutput(arguments.sheet))
    throw Error(
        fmt::format("-o: found \"{}\"; expected the name of a sheet that ends in .png, .pdf or .svg, or -",
                    arguments.sheet.string()));
  requireNoPrintOptions(arguments.picture.picture);
}

ExitCode sheet(const SheetArguments& arguments) {
  const SignalGuard signals(SecondSignal::Ends);
  checkOutput(arguments);
  requireNotInput("-o", arguments.sheet, arguments.inputs);
  Panels panels(arguments);
  const std::size_t count = panels.count();
  if (!arguments.captions.empty() && arguments.captions.size() != count)
    throw Error(fmt::format("--caption: found {} for {} pictures; expected one for each",
                            arguments.captions.size(), count));
  const int columns = arguments.columns > 0
                          ? arguments.columns
                          : static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count))));
  PictureOptions look;
  arguments.picture.picture.readInto(look);
  PanelSize panel;
  arguments.picture.picture.readInto(panel);
  const auto [width, height] = panel.size;
  if (!isPictureSize(panel.size))
    throw Error(
        fmt::format("--panel-size: found {} x {} pixels; expected {}", width, height, pictureSizeWords()));
  const int usual = panels.haveResults() ? columns * width : kUsualWidth;
  const int sheetWidth = arguments.width > 0 ? arguments.width : usual;
  const int panelWidth = sheetPanelWidth(columns, sheetWidth);
  panels.share({panelWidth, panelWidth * height / width});
  const Theme theme = themeOf(look);
  if (isPrintFile(arguments.sheet)) {
    const PrintPage page = printSheet(panels.pages(), columns, sheetWidth, theme);
    makeDirectoryOf(arguments.sheet);
    writePrint(page, arguments.sheet);
  } else {
    const std::vector<SheetPanel> pictures = panels.pictures();
    const OutputTarget target(arguments.sheet, ".png");
    makeDirectoryOf(target.file());
    drawSheet(pictures, columns, sheetWidth, target.file(), theme);
    target.finish();
  }
  return ExitCode::Fine;
}

}  // namespace

void addSheetCommand(CLI::App& app, Action& action) {
  CLI::App* command =
      app.add_subcommand("sheet", "Lay pictures and frames of results out in a grid with captions");
  const auto arguments = std::make_shared<SheetArguments>();
  command
      ->add_option("PICTURE", arguments->inputs,
                   "PNG pictures and results, row by row; a panel for each picture and each frame")
      ->required();
  command->add_option("--columns", arguments->columns, "Panels side by side [as many as rows]")
      ->check(CLI::Range(1, 100));
  command->add_option("--caption", arguments->captions, "What stands under a panel, once per panel [nothing]")
      ->expected(1)
      ->take_all()
      ->check(cannotBeShown)
      ->type_name("TEXT");
  command
      ->add_option("--width", arguments->width,
                   "Width of the sheet in pixels [1600; with results as many panels as there are columns]")
      ->check(CLI::PositiveNumber)
      ->type_name("W");
  addFieldArguments(*command, arguments->picture);
  addPictureOptions(*command, arguments->picture.picture, DrawnPanelOptions{});
  arguments->picture.picture.addTo(*command, PanelSize{});
  arguments->picture.picture.expect("panel_size", sizeWords());
  arguments->picture.picture.addTo(*command, PrintOptions{});
  command
      ->add_option(
          "-o,--output", arguments->sheet,
          "Name of the sheet, .png, or .pdf or .svg for print, where a panel is 80 mm wide; - for a PNG on "
          "standard output")
      ->type_name("SHEET.png|pdf|svg|-")
      ->required();
  command->callback([&action, arguments] { action = [arguments] { return sheet(*arguments); }; });
}

}  // namespace burnish
