#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "engine/results/result_writer.h"
#include "postproc/draw/contour/contour.h"
#include "postproc/draw/contour/field_choice.h"
#include "postproc/mesh/patch_geometry.h"
#include "postproc/mesh/picture_planes.h"
#include "postproc/text/page.h"
#include "tests/cli/browser.h"
#include "tests/postproc/sample_records.h"

/// `burnish view` as the user meets it, with its page in a browser. BURNISH_COMMAND is the program.
namespace burnish {
namespace {

namespace fs = std::filesystem;
using samples::Sample;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class ViewCommand : public testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(dir);
    fs::create_directories(dir);
  }
  void TearDown() override { fs::remove_all(dir); }

  /// Frames of one model, or of bodies that were meshed anew.
  void write(const std::vector<Sample>& frames) const {
    ResultWriter result(dir / "run", frames.front().model);
    for (std::size_t k = 0; k < frames.size(); ++k) {
      FrameRecord frame = frames[k].frame;
      frame.index = static_cast<int>(k);
      frame.time = 0.5 * static_cast<double>(k);
      result.append(frame);
    }
  }

  Outcome view(const std::string& arguments) const {
    return shell(dir, BURNISH_COMMAND " view run " + arguments);
  }

  /// What a script finds on the page of this run.
  std::string found(const std::string& arguments, const std::string& script,
                    const std::string& flags = kWebGl) const {
    const Outcome made = view("-o page.html " + arguments);
    EXPECT_EQ(made.code, 0) << made.err;
    const Outcome page =
        usePage(dir, dir / "page.html",
                "<script>(async () => {\nconst found = [];\ntry {\n" + script +
                    "\n} catch (error) { found.push(error.message); }\ndocument.body.append(Object.assign("
                    "document.createElement(\"pre\"), {textContent: found.join(\"\\n\")}));\n})();</script>",
                flags);
    EXPECT_EQ(page.code, 0) << page.err;
    console = complaintsOf(page);
    return page.out;
  }

  const fs::path dir = fs::temp_directory_path() / ("burnish_view_command_" + std::to_string(::getpid()));
  mutable std::string console;  ///< `complaintsOf` the page
};

/// The number behind a word of what was found.
double numberAfter(const std::string& text, const std::string& word) {
  const std::size_t at = text.find(word + " ");
  if (at == std::string::npos) {
    ADD_FAILURE() << word << " is not in: " << text;
    return HUGE_VAL;
  }
  return std::stod(text.substr(at + word.size() + 1));
}

TEST_F(ViewCommand, WritesAPageThatNeedsNothingElse) {
  write({samples::slab(), samples::slab()});
  const Outcome outcome = view("-o pages/slab.html");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, StartsWith("2 frames in pages/slab.html, 0."));
  const std::string page = readText(dir / "pages/slab.html");
  EXPECT_THAT(page,
              AllOf(Not(HasSubstr("http://")), Not(HasSubstr("https://")), Not(HasSubstr(" style=\""))));
  EXPECT_LT(page.size(), 400'000U);
  ASSERT_EQ(view("-o again.html").code, 0);
  EXPECT_EQ(readText(dir / "again.html"), page) << "equal results give equal pages";
}

TEST_F(ViewCommand, RefusesWhatItCannotShow) {
  Sample rubbed = samples::rubbedSlab();
  rubbed.model.tools.front().name = rubbed.frame.contact.front().tool;
  write({rubbed});
  const auto expectRefused = [&](const std::string& arguments, const std::string& part) {
    const Outcome outcome = view(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_THAT(outcome.err, AllOf(StartsWith("burnish: "), HasSubstr(part)));
    EXPECT_FALSE(fs::exists(dir / "page.html"));
  };
  expectRefused("-o page.pdf", "expected the name of a page that ends in .html");
  expectRefused("-o page.html --field strain", "strain");
  expectRefused("-o page.html --field contact_pressure --warp 2",
                "warp: contact_pressure belongs to the faces");
  expectRefused("-o page.html --frame 7", "there is no frame 7");
  expectRefused("-o page.html --range 0,1", "--range: it goes with one field");
  expectRefused("-o page.html --max-size 0.01", "above --max-size 0.01");
  expectRefused("-o page.html --cut z=0", "--cut");
}

/// Coefficients of the page against the patches of the result: X, Y and the field at places of spans.
constexpr const char* kEvaluate = R"(
const bernstein = (p, t) => {
  let b = [1];
  for (let k = 1; k <= p; ++k) b = Array.from({length: k + 1}, (_, i) => (i > 0 ? t * b[i - 1] : 0) + (i < k ? (1 - t) * b[i] : 0));
  return b;
};
const at = (texels, span, u, v) => {
  const sum = [0, 0, 0, 0];
  bernstein(span.q, v).forEach((b, j) => bernstein(span.p, u).forEach((a, i) => {
    for (let c = 0; c < 4; ++c) sum[c] += a * b * texels[4 * (span.place + j * span.stride + i) + c];
  }));
  return sum.slice(0, 3).map((x) => x / sum[3]);
};
const record = data.frames[state.frame].fields[0];
const values = fieldTexels(loaded.body.mesh, record.values, data.fields[0].components);
let positions = 0, fields = 0;
for (const [span, u, v, x, y, f] of wanted) {
  const place = loaded.body.spans[span], point = at(loaded.body.points, place, u, v);
  positions = Math.max(positions, Math.abs(point[0] + data.origin[0] - x), Math.abs(point[1] + data.origin[1] - y));
  fields = Math.max(fields, Math.abs(at(values, place, u, v)[0] - f));
}
found.push("spans " + loaded.body.spans.length, "positions " + positions, "fields " + fields);
)";

/// Largest differences of a page's positions and values from those of one plane patch, as parts of their sizes.
std::array<double, 2> differences(const Sample& sample, const std::string& field,
                                  const std::function<std::string(const std::string&)>& find) {
  const PatchRecord& record = meshOf(sample.model, sample.frame).patches.front();
  const Patch<2> patch = patchGeometry<2>(record, sample.frame.displacement);
  const Eigen::MatrixXd values = chooseField(sample.model, sample.frame, field).coefficients;
  std::string wanted;
  for (int span = 0; span < patch.basis().numSpans(); ++span)
    for (const Eigen::Vector2d& local : {Eigen::Vector2d(0.0, 1.0), Eigen::Vector2d(0.3, 0.8)}) {
      const auto index = patch.basis().spanIndex(span);
      Eigen::Vector2d xi;
      for (int d = 0; d < 2; ++d) {
        const UnivariateBasis& basis = patch.basis().direction(d);
        const int k = index[static_cast<std::size_t>(d)];
        xi(d) = std::lerp(basis.spanBegin(k), basis.spanEnd(k), local(d));
      }
      const RationalShape<2> shape = patch.shape(span, xi);
      const std::vector<int> functions = patch.basis().spanFunctions(span);
      const Eigen::Vector2d x = patch.points()(Eigen::all, functions) * shape.R;
      double f = 0.0;
      for (std::size_t a = 0; a < functions.size(); ++a)
        f += shape.R(static_cast<Eigen::Index>(a)) *
             values(0, record.nodes[static_cast<std::size_t>(functions[a])]);
      wanted +=
          fmt::format("[{},{},{},{:.17g},{:.17g},{:.17g}],", span, local.x(), local.y(), x.x(), x.y(), f);
    }
  const std::string out = find("const wanted = [" + wanted + "];" + kEvaluate);
  EXPECT_EQ(numberAfter(out, "spans"), patch.basis().numSpans());
  return {numberAfter(out, "positions") / patch.points().cwiseAbs().maxCoeff(),
          numberAfter(out, "fields") / values.cwiseAbs().maxCoeff()};
}

TEST_F(ViewCommand, PageHasTheExactBodies) {
  if (!haveBrowser()) GTEST_SKIP() << "no chromium; scripts/setup installs it";
  const auto expectExact = [&](const std::vector<Sample>& frames, const std::string& field) {
    write(frames);
    const auto [positions, values] = differences(
        frames.back(), field, [&](const std::string& script) { return found("--field " + field, script); });
    EXPECT_LT(positions, 1e-6) << field;
    EXPECT_LT(values, 1e-6) << field;
  };
  expectExact({samples::slab()}, "plastic_strain");  // B-splines
  expectExact({samples::ring()}, "von_mises");       // weights
  expectExact({samples::square()}, "pressure");      // cubic Lagrange elements
  expectExact({samples::slab(), samples::meshedAnew(samples::slab(), samples::slab({20, 5}))},
              "plastic_strain");
}

/// Compares the page with a picture of `render`: of the pixels whose neighbours are alike in the picture, the
/// largest difference of a channel and how many differ by more than `levels`; of all pixels, how many are paper
/// in the one and farther than a pixel from paper in the other.
constexpr const char* kCompare = R"(
const picture = new Image();
picture.src = png;
await picture.decode();
const x0 = Math.ceil(area.x), y0 = Math.ceil(area.y);
const width = Math.floor(area.x + area.width) - x0, height = Math.floor(area.y + area.height) - y0;
const sheet = Object.assign(document.createElement("canvas"), {width: picture.width, height: picture.height}).getContext("2d");
sheet.drawImage(picture, 0, 0);
const wanted = sheet.getImageData(x0, picture.height - y0 - height, width, height).data;
canvas.style.cssText = `position: fixed; left: 0; top: 0; width: ${width}px; height: ${height}px`;
state.zoom *= scale / pixelsPerLength();
const middleOfArea = [area.x + area.width / 2, area.y + area.height / 2];
const shift2 = [x0 + width / 2 - middleOfArea[0], y0 + height / 2 - middleOfArea[1]];
state.center = minus(plus(center, scaled(shift2, 1 / scale)), projected(data.origin));
draw();
const rows = new Uint8Array(4 * width * height), shown = new Uint8Array(4 * width * height);
gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, rows);
for (let y = 0; y < height; ++y) shown.set(rows.subarray(4 * width * y, 4 * width * (y + 1)), 4 * width * (height - 1 - y));
const apart = (a, i, b, j) => Math.max(...[0, 1, 2].map((c) => Math.abs(a[4 * i + c] - b[4 * j + c])));
const isPaper = (a, i) => a[4 * i] + a[4 * i + 1] + a[4 * i + 2] > 3 * 250;
const around = (x, y, reach, act) => {
  for (let v = y - reach; v <= y + reach; ++v) for (let u = x - reach; u <= x + reach; ++u)
    if (u >= 0 && v >= 0 && u < width && v < height) act(v * width + u);
};
let calm = 0, worst = 0, wrong = 0, misplaced = 0;
for (let y = 0; y < height; ++y)
  for (let x = 0; x < width; ++x) {
    const i = y * width + x;
    let uneven = 0, near = false, same = isPaper(shown, i) === isPaper(wanted, i);
    around(x, y, 2, (j) => { uneven = Math.max(uneven, apart(wanted, i, wanted, j)); });
    if (!same) { around(x, y, 1, (j) => { near = near || isPaper(wanted, j) === isPaper(shown, i); }); misplaced += !near; }
    if (uneven > 24 || isPaper(wanted, i)) continue;
    ++calm;
    const off = apart(shown, i, wanted, i);
    worst = Math.max(worst, off);
    wrong += off > levels;
  }
found.push("calm " + calm, "worst " + worst, "wrong " + wrong, "misplaced " + misplaced);
)";

/// The script with a picture drawn with these options.
std::string comparison(const Sample& sample, ContourOptions options, const fs::path& dir, int levels) {
  options.undeformed = options.tools = false;
  options.size = {800, 500};
  const View view = drawContour(sample.model, sample.frame, options, dir / "picture.png");
  std::string cut;
  if (options.cut) {
    Eigen::Index axis = 0;
    options.cut->normal.cwiseAbs().maxCoeff(&axis);
    cut = fmt::format(
        "state.cut = \"xyz\"[{0}]; state.cutPlace = ({1:.17g} - data.origin[{0}] - data.box[{0}]) / (data.box[{0} + 3] - "
        "data.box[{0}]);\n",
        axis, options.cut->point(axis));
  }
  return cut +
         fmt::format(
             "const png = \"{}\", levels = {}, scale = {:.17g}, center = [{:.17g}, {:.17g}], area = {{x: {:.17g}, y: "
             "{:.17g}, width: {:.17g}, height: {:.17g}}};",
             pngUri(readText(dir / "picture.png")), levels, view.pixelsPerLength, view.center.x(),
             view.center.y(), view.area.x, view.area.y, view.area.width, view.area.height) +
         kCompare;
}

TEST_F(ViewCommand, PlaneBodiesLookAsRenderDrawsThem) {
  if (!haveBrowser()) GTEST_SKIP() << "no chromium; scripts/setup installs it";
  const auto expectSame = [&](const Sample& sample, const std::string& field) {
    write({sample});
    ContourOptions options;
    options.field = field;
    const std::string out =
        found("--tools off --undeformed off --field " + field, comparison(sample, options, dir, 2));
    EXPECT_GT(numberAfter(out, "calm"), 30'000) << out;
    // Render is exact to half a step of the scale, so that a pixel may have the colour of the next step.
    EXPECT_LE(numberAfter(out, "worst"), 3) << field << ": " << out;
    EXPECT_LE(numberAfter(out, "wrong"), 1e-4 * numberAfter(out, "calm")) << field << ": " << out;
    EXPECT_EQ(numberAfter(out, "misplaced"), 0) << field << ": " << out;
  };
  expectSame(samples::slab(), "plastic_strain");
  expectSame(samples::slab(), "displacement");
  expectSame(samples::ring(), "von_mises");
  expectSame(samples::square(), "stress.xx");  // colours about zero
  expectSame(samples::twoBodies(), "plastic_strain");
}

TEST_F(ViewCommand, BodiesInSpaceLookAsRenderDrawsThem) {
  if (!haveBrowser()) GTEST_SKIP() << "no chromium; scripts/setup installs it";
  const Sample cube = samples::cube();
  write({cube});
  ContourOptions options;
  options.field = "pressure";
  options.occlusion = false;
  const std::string out =
      found("--tools off --undeformed off --field pressure", comparison(cube, options, dir, 2));
  EXPECT_GT(numberAfter(out, "calm"), 30'000) << out;
  EXPECT_EQ(numberAfter(out, "wrong"), 0) << out;
  EXPECT_EQ(numberAfter(out, "misplaced"), 0) << out;
}

/// The cube bent and bulged, with a field that bends within its spans.
Sample bulgedCube() {
  Sample sample = samples::cube();
  const Eigen::MatrixXd x = sample.model.mesh.patches.front().points;
  Eigen::MatrixXd& u = sample.frame.displacement;
  Eigen::MatrixXd& pressure = sample.frame.fields["pressure"].values;
  for (Eigen::Index k = 0; k < x.cols(); ++k) {
    const auto [a, b, c] = std::array{x(0, k), x(1, k), x(2, k)};
    u.col(k) = Eigen::Vector3d(0.3 * c * (1 - c), 0.2 * a * b, 0.4 * a * (1 - a) * (0.5 + b) + 0.1 * b);
    pressure(0, k) = a + b * b - 2.0 * a * c * (1 - c) * b;
  }
  return sample;
}

/// One cube beside another that has no pressure.
Sample twoCubes() {
  Sample sample = samples::cube();
  MeshRecord& mesh = sample.model.mesh;
  PatchRecord other = mesh.patches.front();
  const int first = mesh.numNodes;
  for (int& node : other.nodes) node += first;
  other.points.row(0).array() += 1.5;
  other.body = 1;
  mesh.numNodes *= 2;
  mesh.patches.push_back(std::move(other));
  sample.model.bodies = {"block", "stamp"};
  sample.frame.displacement = Eigen::MatrixXd::Zero(3, mesh.numNodes);
  FieldRecord& pressure = sample.frame.fields.at("pressure");
  pressure.values = pressure.values.replicate(1, 2).eval();
  pressure.bodies = {"block"};
  return sample;
}

TEST_F(ViewCommand, SectionsLookAsRenderDrawsThem) {
  if (!haveBrowser()) GTEST_SKIP() << "no chromium; scripts/setup installs it";
  const auto expectSame = [&](const Sample& sample, const char* plane) {
    write({sample});
    ContourOptions options;
    options.field = "pressure";
    options.occlusion = false;
    options.cut = cutPlaneNamed(plane);
    const std::string out =
        found("--tools off --undeformed off --field pressure", comparison(sample, options, dir, 2));
    EXPECT_GT(numberAfter(out, "calm"), 20'000) << plane << ": " << out;
    EXPECT_LE(numberAfter(out, "worst"), 3) << plane << ": " << out;
    EXPECT_LE(numberAfter(out, "wrong"), 1e-4 * numberAfter(out, "calm")) << plane << ": " << out;
    EXPECT_EQ(numberAfter(out, "misplaced"), 0) << plane << ": " << out;
  };
  for (const char* plane : {"z=0.31", "z=0.7", "x=0.5", "y=0.333"}) expectSame(bulgedCube(), plane);
  expectSame(samples::cube(), "z=0.5");
}

/// What is known of the section that is shown: its area, how far its corners are from the plane, and their values
/// from x + y + z.
constexpr const char* kMeasureSection = R"(
const measure = (words) => {
  draw();
  const {axis, place, vertices, triangles} = loaded.section, corner = (k) => [...vertices.subarray(7 * k, 7 * k + 4)];
  let area = 0, off = 0, wrong = 0;
  for (let k = 0; k < triangles.length; k += 3) {
    const [a, b, c] = [0, 1, 2].map((i) => corner(triangles[k + i]));
    area += Math.hypot(...cross(minus(b, a), minus(c, a))) / 2;
    for (const [x, y, z, value] of [a, b, c]) {
      off = Math.max(off, Math.abs([x, y, z][axis] - place));
      wrong = Math.max(wrong, Math.abs(Math.abs(x + data.origin[0]) + y + z + data.origin[1] + data.origin[2] - value));
    }
  }
  found.push(words + " area " + area.toFixed(5) + " off " + (off < 1e-6) + " value " + (wrong < 1e-5));
};
)";

TEST_F(ViewCommand, SectionsAreWholeAndExact) {
  if (!haveBrowser()) GTEST_SKIP() << "no chromium; scripts/setup installs it";
  write({samples::cube(), samples::meshedAnew(samples::cube(), samples::cube(4))});
  const std::string out = found("--field pressure", std::string(kMeasureSection) + R"(
for (const [cut, cutPlace] of [["z", 0.4], ["x", 0.5], ["y", 0.25], ["y", 0], ["x", 1]]) {
  Object.assign(state, {cut, cutPlace, frame: 0});
  measure(cut + cutPlace);
  state.frame = 1;
  measure(cut + cutPlace + " anew");
}
)");
  for (const char* cut : {"z0.4", "x0.5", "y0.25", "y0", "x1"})
    for (const char* mesh : {"", " anew"})
      EXPECT_THAT(out, HasSubstr(fmt::format("{}{} area 1.00000 off true value true", cut, mesh)));
  EXPECT_EQ(console, "");

  write({samples::cube()});
  EXPECT_THAT(found("--field pressure --mirror x",
                    std::string(kMeasureSection) +
                        "Object.assign(state, {cut: 'z', cutPlace: 0.4}); measure('both');"),
              HasSubstr("both area 2.00000 off true value true"));
  write({twoCubes()});
  EXPECT_THAT(found("--tools off --undeformed off --field pressure", std::string(kMeasureSection) + R"(
Object.assign(state, {cut: "z", cutPlace: 0.4});
measure("block");
const greyAt = (x) => {
  const [a, b] = minus(projected(minus(x, data.origin)), state.center), pixel = new Uint8Array(4);
  gl.readPixels(Math.round(canvas.width / 2 + a * pixelsPerLength()), Math.round(canvas.height / 2 + b * pixelsPerLength()), 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
  return Math.max(...pixel.slice(0, 3)) - Math.min(...pixel.slice(0, 3)) < 12;
};
found.push("grey " + greyAt([0.53, 0.46, 0.4]) + " " + greyAt([2.03, 0.46, 0.4]));
)"),
              AllOf(HasSubstr("block area 1.00000 off true value true"), HasSubstr("grey false true<")))
      << "the body without the field is hatched";
  write({bulgedCube()});
  EXPECT_THAT(found("--field displacement",
                    std::string(kMeasureSection) +
                        "Object.assign(state, {cut: 'x', cutPlace: 0.6}); measure('bulged');"),
              HasSubstr(" off true "));
}

TEST_F(ViewCommand, PageObeysKeysAndControls) {
  if (!haveBrowser()) GTEST_SKIP() << "no chromium; scripts/setup installs it";
  Sample later = samples::slab();
  later.frame.fields["plastic_strain"].values *= 2.0;
  write({samples::slab(), later});
  const std::string out = found("", R"(
const press = (key, options = {}) => canvas.dispatchEvent(new KeyboardEvent("keydown", {key, bubbles: true, cancelable: true, ...options}));
const text = (id) => byId(id).textContent;
found.push("start " + text("when") + "; " + text("field-title") + "; " + text("largest"));
press(",");
found.push("before " + text("when") + "; " + text("largest") + "; " + byId("frame").value);
press(","); press("k"); press("b"); press("u"); press("t"); press("l");
found.push("keys " + [state.frame, state.knots, state.bands, state.undeformed, state.tools, state.light].join());
found.push("borders " + text("ticks"));
press("f");
found.push("field " + text("field-title") + "; " + byId("field").selectedOptions[0].textContent);
const center = [...state.center];
press("ArrowRight"); press("+");
found.push("moved " + (state.center[0] > center[0]) + " " + state.zoom.toFixed(2));
press("0");
found.push("home " + (state.center[0] === center[0]) + " " + state.zoom);
canvas.dispatchEvent(new WheelEvent("wheel", {deltaY: -100, clientX: 300, clientY: 200, cancelable: true}));
found.push("wheel " + state.zoom.toFixed(3));
pointers.set(1, [300, 200]);
onMove({pointerId: 1, clientX: 310, clientY: 200, buttons: 1});
pointers.set(2, [310, 300]);
onMove({pointerId: 2, clientX: 310, clientY: 400, buttons: 1});
found.push("pinch " + (state.zoom / Math.exp(0.1)).toFixed(2));
pointers.clear();
byId("frame").value = 1;
byId("frame").dispatchEvent(new Event("input"));
found.push("slid " + text("when"));
press(" ");
await new Promise((done) => setTimeout(done, 150));
found.push("played " + state.frame + " " + text("play"));
press(" ");
found.push("paused " + text("play"));
found.push("label " + canvas.getAttribute("aria-label"));
found.push("unnamed " + [...document.querySelectorAll("input, select, button")].filter((e) => !e.textContent.trim() && !e.labels?.length && !e.ariaLabel).length);
found.push("requests " + performance.getEntriesByType("resource").filter((r) => !r.name.startsWith("data:")).length);
found.push("wide " + (document.documentElement.scrollWidth > innerWidth));
)");
  for (const char* line :
       {"start t = 0.5, frame 2 of 2; Equivalent plastic strain ε̄p; max ", "before t = 0, frame 1 of 2; max ",
        "keys 0,true,5,false,false,true\n", "borders 0.00.40.81.21.62.0\n",
        "field Displacement |u| [mm]; Displacement\n", "moved true 1.20\n", "home true 1\n", "wheel 1.105\n",
        "pinch 2.00\n", "slid t = 0.5, frame 2 of 2\n", "played 0 Pause\n", "paused Play\n", "label ",
        "unnamed 0\n", "requests 0\n", "wide false<"})
    EXPECT_THAT(out, HasSubstr(line));
  EXPECT_EQ(console, "");
}

TEST_F(ViewCommand, BodiesInSpaceTurnAndAreCut) {
  if (!haveBrowser()) GTEST_SKIP() << "no chromium; scripts/setup installs it";
  write({samples::cube()});
  const std::string out = found("--tools off --undeformed off", R"(
const press = (key) => canvas.dispatchEvent(new KeyboardEvent("keydown", {key, bubbles: true, cancelable: true}));
const seen = () => { const e = eye(); return e.map((x) => x.toFixed(2)).join(); };
const colourAt = (x) => {
  draw();
  const [a, b] = minus(projected(x), state.center), pixel = new Uint8Array(4);
  gl.readPixels(Math.round(canvas.width / 2 + a * pixelsPerLength()), Math.round(canvas.height / 2 + b * pixelsPerLength()), 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
  return [...pixel.slice(0, 3)];
};
const grey = (c) => Math.max(...c) - Math.min(...c) < 12;
press("ArrowRight"); press("ArrowUp");
found.push("turned " + seen() + " " + [dot(state.right, state.up), dot(state.right, state.right)].map((x) => x.toFixed(6)).join());
press("0");
found.push("home " + seen());
const z = data.box[5], inside = [0.13, 0.11, 0];
found.push("whole " + grey(colourAt([0.13, 0.11, z])));
press("z");
found.push("cut " + state.cut + " " + grey(colourAt(inside)));
delete loaded.body.mesh.volumes;
found.push("hatched " + grey(colourAt(inside)));
press("]");
found.push("place " + state.cutPlace.toFixed(2));
press("z");
found.push("closed " + grey(colourAt([0.13, 0.11, z])));
)");
  EXPECT_THAT(out, HasSubstr("home 0.41,0.37,0.83\n")) << "(0.5, 0.45, 1), of length 1";
  EXPECT_THAT(out, AllOf(HasSubstr(" 0.000000,1.000000\n"), Not(HasSubstr("turned 0.41,0.37"))));
  EXPECT_THAT(out, HasSubstr("whole false\ncut z false\nhatched true\nplace 0.52\nclosed false<"));
}

/// The ball over the cube has an edge where it turns away from the eye, and is filled where the cut goes through it; axes
/// point as the body lies.
TEST_F(ViewCommand, ToolsInSpaceHaveSilhouettesAndAreClosedWhereTheyAreCut) {
  if (!haveBrowser()) GTEST_SKIP() << "no chromium; scripts/setup installs it";
  write({samples::cube()});
  const std::string out = found("--undeformed off", R"(
const center = minus([0.5, 1.25, 0.5], data.origin);
const darkestAt = (x) => {
  draw();
  const [a, b] = minus(projected(x), state.center), pixels = new Uint8Array(4 * 25);
  gl.readPixels(Math.round(canvas.width / 2 + a * pixelsPerLength()) - 2, Math.round(canvas.height / 2 + b * pixelsPerLength()) - 2, 5, 5, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  return Math.min(...[...pixels].filter((_, k) => k % 4 === 0));
};
const tool = Math.round(255 * rgb(theme().tool)[0]);
const around = [0, 1, 2, 3, 4, 5].map((k) => plus(center, plus(scaled(state.right, 0.25 * Math.cos(k)), scaled(state.up, 0.25 * Math.abs(Math.sin(k))))));
found.push("edges " + around.every((x) => darkestAt(x) < 90));
found.push("inside " + (darkestAt(center) > tool - 60));
Object.assign(state, {cut: "z", cutPlace: 0.5});
found.push("filled " + (Math.abs(darkestAt(center) - tool) <= 1));
found.push("edge " + (darkestAt(plus(center, [0, 0.25, 0])) < 90));
state.tools = false;
found.push("without " + darkestAt(center));
Object.assign(state, {right: [0, 0, -1], up: [0, 1, 0]});
draw();
const places = Object.fromEntries([...byId("axes").querySelectorAll("text")].map((name) => [name.textContent, [Math.sign(name.getAttribute("x")), Math.sign(name.getAttribute("y"))].join()]));
found.push("axes " + places.y + " " + places.z + " " + getComputedStyle(byId("axes")).display);
)");
  for (const char* line : {"edges true\n", "inside true\n", "filled true\n", "edge true\n", "without 255\n",
                           "axes 0,-1 -1,0 block"})
    EXPECT_THAT(out, HasSubstr(line));
  EXPECT_EQ(console, "");
}

TEST_F(ViewCommand, ContactFieldsLieAlongTheirFaces) {
  if (!haveBrowser()) GTEST_SKIP() << "no chromium; scripts/setup installs it";
  Sample rubbed = samples::rubbedSlab();
  rubbed.model.tools.front().name = rubbed.frame.contact.front().tool;
  write({rubbed});
  const std::string out =
      found("--tools off --undeformed off --field contact_pressure,sliding,plastic_strain", R"(
const colourAt = (x, y) => {
  draw();
  const [a, b] = minus(projected(minus([x, y, 0], data.origin)), state.center), pixel = new Uint8Array(4);
  gl.readPixels(Math.round(canvas.width / 2 + a * pixelsPerLength()), Math.round(canvas.height / 2 + b * pixelsPerLength()), 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
  return [...pixel.slice(0, 3)].join();
};
found.push("middle " + colourAt(1.5, 0.85), "open " + colourAt(0.3, 0.946), "body " + colourAt(1.37, 0.43));
found.push("words " + byId("field").selectedOptions[0].textContent + "; " + byId("largest").textContent);
change({field: 1, bands: 5});
found.push("stick " + colourAt(1.5, 0.85), "states " + byId("ticks").textContent);
change({field: 2});
found.push("strain " + (colourAt(1.37, 0.43) !== "238,238,238"));
)");
  EXPECT_THAT(out, AllOf(HasSubstr("open 68,1,84\n"), HasSubstr("body 238,238,238\n"),
                         HasSubstr("words Contact pressure"), HasSubstr("strain true")));
  EXPECT_THAT(out, testing::ContainsRegex("middle 2[45][0-9],2[23][0-9],[23][0-9]\n"));
  EXPECT_THAT(out, HasSubstr("states openstickslip\n"));
  EXPECT_EQ(console, "");
}

TEST_F(ViewCommand, AToolThatHasBeenTakenAwayIsNotDrawn) {
  if (!haveBrowser()) GTEST_SKIP() << "no chromium; scripts/setup installs it";
  Sample sample = samples::slab();
  sample.model.tools.push_back(sample.model.tools.at(0));
  sample.model.tools[0].name = "stays";
  sample.model.tools[1].until = 0.5;
  sample.frame.toolDisplacement.conservativeResize(2, 2);
  sample.frame.toolDisplacement.col(1) = sample.frame.toolDisplacement.col(0);
  write({sample, sample, sample});
  const std::string out = found("--undeformed off", R"(
for (const frame of [0, 1, 2]) {
  state.frame = frame;
  const tools = [];
  forTools((tool) => tools.push(tool.name));
  found.push("frame" + frame + " " + tools);
}
)");
  const std::string other = sample.model.tools[1].name;
  for (const std::string& line :
       {"frame0 stays," + other, "frame1 stays," + other, std::string("frame2 stays<")})
    EXPECT_THAT(out, HasSubstr(line));
  EXPECT_EQ(console, "");
}

TEST_F(ViewCommand, PictureStandsInForWebGl) {
  if (!haveBrowser()) GTEST_SKIP() << "no chromium; scripts/setup installs it";
  write({samples::slab()});
  const std::string out = found("", R"(
await new Promise((done) => (document.readyState === "complete" ? done() : addEventListener("load", done)));
found.push("picture " + byId("picture").naturalWidth + " " + (byId("fallback").offsetHeight > 100) + " " + byId("picture").alt);
found.push("rest " + ["space", "scale", "controls"].filter((id) => byId(id).offsetHeight > 0).length);
)",
                                "--disable-3d-apis");
  EXPECT_THAT(out, HasSubstr("picture 1280 true "));
  EXPECT_THAT(out, HasSubstr("Equivalent plastic strain\nrest 0<"));
}

TEST_F(ViewCommand, PageRunsNoScriptButItsOwn) {
  if (!haveBrowser()) GTEST_SKIP() << "no chromium; scripts/setup installs it";
  write({samples::slab()});
  ASSERT_EQ(view("-o page.html --title '</script><b>Slab'").code, 0);
  std::string page = readText(dir / "page.html");
  const auto titleOf = [&] {
    writeText(page, dir / "page.html");
    return usePage(
               dir, dir / "page.html",
               "<script>document.body.append(Object.assign(document.createElement(\"pre\"), {textContent: "
               "\"title \" + document.getElementById(\"title\").textContent + \" \" + "
               "getComputedStyle(document.body).display}));</script>",
               kWebGl)
        .out;
  };
  EXPECT_THAT(titleOf(), HasSubstr("title &lt;/script&gt;&lt;b&gt;Slab grid"));
  page.replace(page.find("const texelsPerRow"), 5, "let  ");
  page.replace(page.find("#fff"), 4, "#ffe");
  EXPECT_THAT(titleOf(), HasSubstr("title  block")) << "neither the changed script nor the changed style";
}

}  // namespace
}  // namespace burnish
