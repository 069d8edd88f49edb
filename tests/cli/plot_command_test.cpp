#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/cli/shell_test.h"

/// `burnish plot` as the user meets it. BURNISH_COMMAND is the program.
namespace burnish {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class PlotCommand : public ShellTest {
 protected:
  void SetUp() override {
    ShellTest::SetUp();
    writeRun("coarse", "time,energy,tool.fy\n0,0,1\n1,2,1\n2,4,8\n");
    writeRun("fine", "time,energy,tool.fy\n0,0,1\n0.5,0.5,2\n1,1,3\n2,4,5\n");
  }

  void writeRun(const std::string& name, const std::string& history) const {
    fs::create_directories(dir / name);
    std::ofstream(dir / name / "history.csv") << history;
  }

  Outcome plot(const std::string& arguments) const {
    return shell(dir, BURNISH_COMMAND " plot " + arguments);
  }

  /// What --csv - prints.
  std::string data(const std::string& arguments) const {
    const Outcome outcome = plot(arguments + " --csv -");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.out;
  }

  std::string columns(const std::string& arguments) const {
    const std::string text = data(arguments);
    return text.substr(0, text.find('\n'));
  }

  void expectRefused(const std::string& arguments, const std::vector<std::string>& parts) const {
    const Outcome outcome = plot(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_TRUE(outcome.err.starts_with("burnish: ")) << outcome.err;
    for (const std::string& part : parts) EXPECT_THAT(outcome.err, HasSubstr(part));
  }
};

TEST_F(PlotCommand, PrintsTheDataThatItDraws) {
  EXPECT_EQ(data("coarse fine --y energy --where 'time > 0'"),
            "coarse x,coarse y,fine x,fine y\n1,2,0.5,0.5\n2,4,1,1\n,,2,4\n");
}

TEST_F(PlotCommand, NamesCurvesByWhatTellsThemApart) {
  EXPECT_EQ(columns("coarse --y energy"), "coarse x,coarse y");
  EXPECT_EQ(columns("coarse --y energy --y tool.fy"), "energy x,energy y,tool.fy x,tool.fy y");
  EXPECT_EQ(columns("coarse fine --y energy --y2 tool.fy"),
            "coarse x,coarse y,fine x,fine y,coarse x2,coarse y2,fine x2,fine y2");
  EXPECT_THAT(columns("coarse fine --y energy --y tool.fy"), HasSubstr("fine: energy y,coarse: tool.fy x"));
  EXPECT_EQ(columns("coarse fine --y energy --label a --label b"), "a x,a y,b x,b y");
  EXPECT_EQ(columns("coarse --y energy --y tool.fy --label a --label b"), "a x,a y,b x,b y");
  fs::create_directories(dir / "other");
  fs::copy(dir / "fine", dir / "other/fine");
  EXPECT_EQ(columns("fine other/fine --y energy"), "fine x,fine y,other/fine x,other/fine y");
}

TEST_F(PlotCommand, DrawsDifferencesAndTellsTheLargest) {
  Outcome outcome = plot("coarse fine --y energy --y tool.fy --reference fine -o d.png --csv d.csv");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out,
            "coarse: largest difference of energy: 1 (25 %) at time = 1\n"
            "coarse: largest difference of tool.fy: 3 (60 %) at time = 2\n");
  EXPECT_TRUE(fs::exists(dir / "d.png"));
  EXPECT_EQ(readText(dir / "d.csv"),
            "coarse: energy x,coarse: energy y,coarse: tool.fy x,coarse: tool.fy y\n"
            "0,0,0,0\n1,1,1,-2\n2,0,2,3\n");
  outcome = plot("coarse --y energy --reference fine --difference relative --csv -");
  EXPECT_EQ(outcome.out, "coarse x,coarse y\n0,0\n1,0.25\n2,0\n");
  EXPECT_THAT(outcome.err, HasSubstr("largest difference of energy: 1 (25 %)"));
}

TEST_F(PlotCommand, WritesTextThatCanBeSelected) {
  const Outcome outcome = plot(
      "coarse fine --y 'energy*1e-6' --y2 tool.fy --log y2 --y2-range 0.1,10 --theme dark --markers all "
      "--y2-title 'force F₁' -o c.svg && " BURNISH_COMMAND " plot coarse --y energy -o c.pdf");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const std::string svg = readText(dir / "c.svg");
  for (const char* text : {"<text", "force F₁", "fine (right)", "×10⁻⁶", "#18"})
    EXPECT_THAT(svg, HasSubstr(text));
  EXPECT_THAT(shell(dir, "pdffonts c.pdf").out, HasSubstr("DejaVuSans"));
}

/// A text of its own in an SVG file.
auto hasText(const std::string& text) {
  return HasSubstr("  " + text + "\n");
}

TEST_F(PlotCommand, HasWordsForColumns) {
  writeRun("tool",
           "time,tool.ux,tool.uy,tool.fx,tool.fy,face.fy,strain_energy\n0,0,0,0,0,0,0\n1,0,-1,0,2,-2,3\n");
  const auto svgOf = [&](const std::string& arguments) {
    EXPECT_EQ(plot(arguments + " -o worded.svg").code, 0);
    return readText(dir / "worded.svg");
  };
  EXPECT_THAT(svgOf("tool --y tool.fy"),
              AllOf(hasText("Force on tool in y"), hasText("Time"), Not(hasText("tool"))));
  EXPECT_THAT(svgOf("tool --y tool.fy --label press"), hasText("press"));
  EXPECT_THAT(svgOf("tool --y tool.fx --y tool.fy"),
              AllOf(hasText("Force"), hasText("Force on tool in x"), hasText("Force on tool in y")));
  EXPECT_THAT(svgOf("tool --y face.fy"), hasText("face.fy"));
  EXPECT_THAT(svgOf("tool --y 'tool.fy / 2'"), hasText("tool.fy / 2"));
  EXPECT_THAT(svgOf("tool --y tool.fy --y strain_energy"), hasText("tool.fy, strain_energy"));
  EXPECT_THAT(svgOf("tool --y tool.fy --y-title F"), Not(HasSubstr("Force on")));
}

TEST_F(PlotCommand, HasUnitsWhereTheResultIsThere) {
  std::ofstream(dir / "press.yaml") << "geometry: {shape: rectangle, size: [2, 1], spans: [2, 1]}\n"
                                       "units: {length: mm, stress: MPa}\n"
                                       "material: {law: neo-hookean, E: 1, nu: 0.3}\n"
                                       "supports: [{face: bottom, fix: [x, y]}]\n"
                                       "tools: [{name: die, shape: plane, origin: [0, 1], normal: [0, -1], "
                                       "motion: {times: [0, 1], y: [0, -0.01]}}]\n"
                                       "contact: [{tool: die, face: top}]\n"
                                       "steps: [{until: 1, count: 1}]\n";
  const auto svgOf = [&](const std::string& changes) {
    const Outcome outcome = shell(dir, BURNISH_COMMAND " run press.yaml -o pressed --quiet " + changes +
                                           " && " BURNISH_COMMAND
                                           " plot pressed --x die.uy --y die.fy --y2 strain_energy -o p.svg");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return readText(dir / "p.svg");
  };
  EXPECT_THAT(svgOf(""), AllOf(hasText("Displacement of die in y [mm]"), hasText("Force on die in y [N/mm]"),
                               hasText("Strain energy [N·mm/mm]")));
  EXPECT_THAT(svgOf("--set kinematics=axisymmetric --set geometry.origin=[1,0]"),
              AllOf(hasText("Force on die in y [N]"), hasText("Strain energy [N·mm]")));
}

TEST_F(PlotCommand, RefusesWhatDoesNotFit) {
  expectRefused("coarse --y enrgy -o c.png", {"coarse/history.csv", "no column \"enrgy\"", "\"energy\"?"});
  expectRefused("coarse --y energy --y2 'tool.fx*2' -o c.png", {"character 1", "\"tool.fy\"?"});
  expectRefused("coarse --y energy", {"-o", ".png, .svg or .pdf", "--csv"});
  expectRefused("coarse --y energy --x-range 2 -o c.png", {"--x-range: found \"2\"; expected LO,HI"});
  expectRefused("coarse --y energy --y-range 2,1 -o c.png", {"--y-range: found \"2,1\""});
  expectRefused("coarse --y energy --y2-range 1,2 -o c.png", {"--y2-range requires --y2"});
  expectRefused("coarse --y energy --difference relative -o c.png", {"--difference requires --reference"});
  expectRefused("coarse --y energy --reference fine --difference relativ -o c.png", {"\"relative\"?"});
  expectRefused("fine --y energy --reference fine -o c.png", {"--reference", "no other run"});
  expectRefused("coarse --y energy --x 'abs(time-1)' --reference fine -o c.png",
                {"coarse/history.csv: energy over abs(time-1)", "only grows or only falls"});
  expectRefused("coarse --y energy --markers som -o c.png", {"--markers: found \"som\"", "\"some\"?"});
  expectRefused("coarse --y energy --theme drak -o c.png", {"\"drak\"", "\"dark\"?"});
  expectRefused("coarse --y energy --log x,z -o c.png", {"--log"});
  expectRefused("coarse fine --y energy --y2 tool.fy --label a -o c.png",
                {"--label: found 1 for 2 histories", "4 curves"});
  expectRefused("coarse --y energy --y-range=-1e308,1e308 -o c.png", {"--y-range: found \"-1e308,1e308\""});
  writeRun("huge", "time,energy\n0,-1e308\n1,1e308\n");
  expectRefused("huge --y energy -o c.png", {"point 1 of \"huge\" has y = -1e+308", "up to 1e+300"});
  for (const auto& entry : fs::directory_iterator(dir)) EXPECT_NE(entry.path().extension(), ".png");
}

}  // namespace
}  // namespace burnish
