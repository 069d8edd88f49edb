#include <gtest/gtest.h>
#include <hdf5.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <random>
#include <sstream>

#include "engine/core/error.h"
#include "engine/results/history.h"
#include "engine/results/result_reader.h"
#include "engine/results/result_writer.h"
#include "engine/results/summary_file.h"
#include "tests/message_of.h"

/// HDF5 1.10 forgets memory of its own when it meets damaged metadata; the leak sanitizer is not to report
/// that.
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libhdf5";
}

namespace burnish {
namespace {

namespace fs = std::filesystem;

/// A directory of its own for every test, deleted at its end.
class Results : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    dir = fs::temp_directory_path() /
          (std::string("burnish_results_") + test->name() + std::to_string(::getpid()));
    fs::remove_all(dir);
    fs::create_directories(dir);
  }
  void TearDown() override {
    fs::remove_all(dir);
    EXPECT_EQ(H5Fget_obj_count(H5F_OBJ_ALL, H5F_OBJ_ALL), 0) << "HDF5 objects are left open";
  }

  fs::path dir;
};

void expectError(const std::function<void()>& action, const std::string& part) {
  const std::string message = messageOf(action);
  EXPECT_NE(message.find(part), std::string::npos)
      << "message: \"" << message << "\", expected: \"" << part << "\"";
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

std::string contents(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

void overwrite(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

/// Numbers without a pattern, different for every seed.
Eigen::MatrixXd numbers(Eigen::Index rows, Eigen::Index columns, int seed) {
  std::mt19937_64 random(static_cast<std::uint64_t>(seed));
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return uniform(random); });
}

/// n x n B-splines of degree 2 beside one Lagrange element of degree 2 with nodes of its own.
ModelRecord sampleModel(int n = 4, const std::string& title = "sample") {
  const std::vector<double> knots = KnotVector::uniform(2, n - 2).knots();
  const DirectionRecord spline{.family = BasisFamily::BSpline, .degree = 2, .knots = knots};
  const DirectionRecord lagrange{.family = BasisFamily::Lagrange, .degree = 2, .knots = {0.0, 1.0}};
  ModelRecord model{.program = "burnish test",
                    .title = title,
                    .sceneYaml = "title: σ\n",
                    .dim = 2,
                    .lengthUnit = "mm",
                    .stressUnit = "MPa",
                    .mesh = {.numNodes = n * n + 9, .patches = {}},
                    .bodies = {},
                    .tools = {},
                    .subdivision = 3};
  for (const auto& [direction, first, count] :
       {std::tuple(spline, 0, n * n), std::tuple(lagrange, n * n, 9)}) {
    PatchRecord patch{.directions = {direction, direction},
                      .points = numbers(2, count, 1),
                      .weights = numbers(1, count, 2).cwiseAbs().transpose().array() + 0.1,
                      .nodes = {}};
    for (int i = 0; i < count; ++i) patch.nodes.push_back(first + i);
    model.mesh.patches.push_back(patch);
  }
  model.tools = {{.name = "cylinder", .shape = Cylinder{{0.5, 1.5, 0.0}, {0.0, 0.0, 1.0}, 0.5}},
                 {.name = "ball", .shape = Sphere{{1.0, 2.0, 3.0}, 0.25}, .until = 0.75},
                 {.name = "plate", .shape = Plane{{0.0, 1.0, 0.0}, {0.6, -0.8, 0.0}}},
                 {.name = "key",
                  .shape = SurfaceMesh{numbers(3, 4, 6), Eigen::MatrixXi{{0, 1, 2}, {1, 2, 3}}, false},
                  .pivot = {1.0, 2.0, 0.0},
                  .axis = {0.0, 0.6, 0.8},
                  .halfThickness = 0.25}};
  return model;
}

FrameRecord sampleFrame(const ModelRecord& model, int index, int quadraturePoints = 12) {
  const auto nodes = static_cast<Eigen::Index>(model.mesh.numNodes);
  FrameRecord frame{.index = index,
                    .step = 3 * index,
                    .time = index / 7.0,
                    .mesh = {},
                    .displacement = numbers(2, nodes, index),
                    .fields = {},
                    .toolDisplacement = numbers(2, 4, index + 1),
                    .toolAngle = numbers(1, 4, index + 4).transpose(),
                    .contact = {},
                    .quadrature = {}};
  frame.fields["plastic_strain"] = {.components = {}, .unit = "", .values = numbers(1, nodes, index + 2)};
  frame.fields["stress"] = {
      .components = {"xx", "yy", "xy", "zz"}, .unit = "MPa", .values = numbers(4, nodes, index + 3)};
  frame.contact.push_back({.tool = "cylinder",
                           .face = "top",
                           .patch = 0,
                           .nodes = {0, 2, 1},
                           .pressure = numbers(3, 1, index + 4),
                           .averageGap = numbers(3, 1, index + 5),
                           .active = {1, 0, 1},
                           .quadraturePoints = numbers(2, 5, index + 6),
                           .quadraturePressure = numbers(5, 1, index + 7),
                           .quadratureGap = numbers(5, 1, index + 8),
                           .quadratureNormal = numbers(2, 5, index + 11)});
  frame.contact.push_back(frame.contact.front());
  frame.contact.back().tool.clear();  // contact of the face with itself
  frame.quadrature.positions = numbers(2, quadraturePoints, index + 9);
  frame.quadrature.fields["pressure"] = {
      .components = {}, .unit = "MPa", .values = numbers(1, quadraturePoints, index + 10)};
  return frame;
}

/// The same of a body that has been meshed anew, with n x n B-splines.
FrameRecord frameOnNewMesh(const ModelRecord& model, int index, int n) {
  ModelRecord meshedAnew = model;
  meshedAnew.mesh = sampleModel(n).mesh;
  FrameRecord frame = sampleFrame(meshedAnew, index);
  frame.mesh = meshedAnew.mesh;
  return frame;
}

bool same(const std::map<std::string, FieldRecord>& a, const std::map<std::string, FieldRecord>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
    return x.first == y.first && x.second.components == y.second.components &&
           x.second.unit == y.second.unit && x.second.values == y.second.values;
  });
}

bool same(const ContactRecord& a, const ContactRecord& b) {
  return a.tool == b.tool && a.face == b.face && a.patch == b.patch && a.nodes == b.nodes &&
         a.pressure == b.pressure && a.averageGap == b.averageGap && a.active == b.active &&
         a.quadraturePoints == b.quadraturePoints && a.quadraturePressure == b.quadraturePressure &&
         a.quadratureGap == b.quadratureGap && a.quadratureNormal == b.quadratureNormal;
}

bool same(const PatchRecord& a, const PatchRecord& b) {
  return a.points == b.points && a.weights == b.weights && a.nodes == b.nodes &&
         std::equal(a.directions.begin(), a.directions.end(), b.directions.begin(), b.directions.end(),
                    [](const DirectionRecord& x, const DirectionRecord& y) {
                      return x.family == y.family && x.degree == y.degree && x.knots == y.knots;
                    });
}

bool same(const MeshRecord& a, const MeshRecord& b) {
  return a.numNodes == b.numNodes &&
         std::equal(a.patches.begin(), a.patches.end(), b.patches.begin(), b.patches.end(),
                    [](const PatchRecord& x, const PatchRecord& y) { return same(x, y); });
}

bool same(const FrameRecord& a, const FrameRecord& b) {
  return a.index == b.index && a.step == b.step && a.time == b.time &&
         a.mesh.has_value() == b.mesh.has_value() && (!a.mesh || same(*a.mesh, *b.mesh)) &&
         a.displacement == b.displacement && same(a.fields, b.fields) &&
         a.toolDisplacement == b.toolDisplacement && a.toolAngle == b.toolAngle &&
         std::equal(a.contact.begin(), a.contact.end(), b.contact.begin(), b.contact.end(),
                    [](const ContactRecord& x, const ContactRecord& y) { return same(x, y); }) &&
         a.quadrature.positions == b.quadrature.positions && same(a.quadrature.fields, b.quadrature.fields);
}

bool same(const RecordedShape& a, const RecordedShape& b) {
  if (a.index() != b.index()) return false;
  if (const auto* plane = std::get_if<Plane>(&a))
    return plane->origin == std::get<Plane>(b).origin && plane->normal == std::get<Plane>(b).normal;
  if (const auto* sphere = std::get_if<Sphere>(&a))
    return sphere->center == std::get<Sphere>(b).center && sphere->radius == std::get<Sphere>(b).radius;
  if (const auto* mesh = std::get_if<SurfaceMesh>(&a)) {
    const auto& other = std::get<SurfaceMesh>(b);
    return mesh->points == other.points && mesh->cells == other.cells && mesh->closed == other.closed;
  }
  const auto &x = std::get<Cylinder>(a), &y = std::get<Cylinder>(b);
  return x.center == y.center && x.axis == y.axis && x.radius == y.radius;
}

bool same(const ModelRecord& a, const ModelRecord& b) {
  return a.bodies == b.bodies && a.program == b.program && a.title == b.title && a.sceneYaml == b.sceneYaml &&
         a.dim == b.dim && a.lengthUnit == b.lengthUnit && a.stressUnit == b.stressUnit &&
         same(a.mesh, b.mesh) && a.subdivision == b.subdivision &&
         std::equal(a.tools.begin(), a.tools.end(), b.tools.begin(), b.tools.end(),
                    [](const ToolRecord& x, const ToolRecord& y) {
                      return x.name == y.name && same(x.shape, y.shape) && x.pivot == y.pivot &&
                             x.axis == y.axis && x.halfThickness == y.halfThickness && x.until == y.until;
                    });
}

void writeSample(const fs::path& dir, int frames) {
  const ModelRecord model = sampleModel();
  ResultWriter writer(dir, model);
  for (int i = 0; i < frames; ++i) writer.append(sampleFrame(model, i));
}

/// Runs the action in a child process and returns its exit code.
int exitCodeOf(const std::function<int()>& action) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(action());
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST_F(Results, ReadBackExactly) {
  const ModelRecord model = sampleModel();
  ResultWriter writer(dir / "new" / "run", model);
  FrameRecord last = sampleFrame(model, 2);
  last.fields["stress"].values(0, 0) = std::numeric_limits<double>::denorm_min();
  last.fields["stress"].values(1, 0) = -0.0;
  writer.append(sampleFrame(model, 0));
  writer.append(sampleFrame(model, 1));
  writer.append(last);

  for (const fs::path& path : {dir / "new" / "run", dir / "new" / "run" / "result.h5"}) {
    const ResultReader reader(path);
    EXPECT_TRUE(same(reader.model(), model));
    ASSERT_EQ(reader.numFrames(), 3);
    EXPECT_EQ(reader.times(), (std::vector<double>{0.0, 1.0 / 7.0, 2.0 / 7.0}));
    EXPECT_TRUE(same(reader.frame(1), sampleFrame(model, 1)));
    EXPECT_TRUE(same(reader.frame(2), last));
    EXPECT_TRUE(std::signbit(reader.frame(2).fields.at("stress").values(1, 0)));
  }
}

/// The patches of the sample as two bodies.
ModelRecord sampleOfBodies() {
  ModelRecord model = sampleModel();
  model.bodies = {"block", "punch"};
  model.mesh.patches[1].body = 1;
  return model;
}

TEST_F(Results, SeveralBodiesReadBackExactly) {
  const ModelRecord model = sampleOfBodies();
  FrameRecord frame = sampleFrame(model, 0);
  frame.fields["plastic_strain"].bodies = {"punch"};
  frame.quadrature.numPoints = {5, 7};
  ResultWriter(dir, model).append(frame);
  const ResultReader reader(dir);
  EXPECT_EQ(reader.model().bodies, model.bodies);
  EXPECT_EQ(reader.model().mesh.patches[0].body, 0);
  EXPECT_EQ(reader.model().mesh.patches[1].body, 1);
  EXPECT_EQ(reader.frame(0).fields.at("plastic_strain").bodies, std::vector<std::string>{"punch"});
  EXPECT_TRUE(reader.frame(0).fields.at("stress").bodies.empty());
  EXPECT_EQ(reader.frame(0).quadrature.numPoints, (std::vector<int>{5, 7}));
}

TEST_F(Results, FramesOfABodyMeshedAnewReadBackExactly) {
  const ModelRecord model = sampleModel();
  const std::vector<FrameRecord> frames{sampleFrame(model, 0), frameOnNewMesh(model, 1, 6),
                                        frameOnNewMesh(model, 2, 3), sampleFrame(model, 3)};
  ResultWriter writer(dir, model);
  for (const FrameRecord& frame : frames) writer.append(frame);
  const ResultReader reader(dir);
  ASSERT_EQ(reader.numFrames(), 4);
  EXPECT_TRUE(same(reader.model(), model));
  for (std::size_t k = 0; k < frames.size(); ++k)
    EXPECT_TRUE(same(reader.frame(static_cast<int>(k)), frames[k])) << k;
  const FrameRecord first = reader.frame(0), second = reader.frame(1);
  EXPECT_EQ(meshOf(reader.model(), first).numNodes, 4 * 4 + 9);
  EXPECT_EQ(meshOf(reader.model(), second).numNodes, 6 * 6 + 9);
}

TEST_F(Results, LargeArraysAndTextsReadBackExactly) {
  ModelRecord model = sampleModel(60);
  model.sceneYaml = std::string(200'000, 'x');
  const FrameRecord frame = sampleFrame(model, 0, 150'000);
  ResultWriter(dir, model).append(frame);
  const ResultReader reader(dir);
  EXPECT_TRUE(same(reader.model(), model));
  EXPECT_TRUE(same(reader.frame(0), frame));
}

TEST_F(Results, ModelWithoutToolsFieldsAndTitlesReadsBack) {
  ModelRecord model = sampleModel(4, "");
  model.tools.clear();
  model.sceneYaml.clear();
  FrameRecord frame = sampleFrame(model, 0, 0);
  frame.fields.clear();
  frame.contact.clear();
  frame.toolDisplacement.resize(2, 0);
  frame.toolAngle.resize(0);
  ResultWriter(dir, model).append(frame);
  EXPECT_TRUE(same(ResultReader(dir).model(), model));
  EXPECT_TRUE(same(ResultReader(dir).frame(0), frame));
}

/// An account with every entry.
RunAccount fullAccount() {
  RunAccount account;
  account.program = "burnish 0 (engine 0)";
  account.stoppedBecause = "at t = 0.1: the iteration diverged";
  account.advice = "take more steps";
  account.doubts = {{"smallest J below 0.05", 0.1, 3, "at worst: 0.01"}, {"unstable", 1.0 / 3.0, 1}};
  account.warnings = {"material.nu: 0.4999 is nearly incompressible"};
  account.idleTools = {"die", "blank: holder"};
  account.reactions = {{"floor", "bottom", {0.0, -1.0 / 3.0}, {}, 2.5, 0.1}};
  account.rezonings = {{.time = 0.1, .quality = 0.25, .iterations = 7}};
  account.rezoningFailure = "t = 0.2: no mesh of the deformed body is sound";
  account.timings = {.assembly = 0.25, .contact = 0.5, .total = 1.0 / 3.0};
  account.steps = 12;
  account.iterations = 1L << 40;
  account.worstResidual = 1e-12;
  account.vonMisesMinimum = -0.5;
  account.plasticStrainMinimum = -1e-3;
  account.stabilisedShare = 0.0;
  account.largestStabilisedShare = 0.125;
  account.stabilisationWork = 1e-9;
  return account;
}

TEST_F(Results, SummaryReadsBackExactlyAndIsRefusedWhenDamaged) {
  const RunAccount written = fullAccount();
  writeSummary(dir, written);
  const std::string text = contents(dir / "summary.yaml");
  const RunAccount read = readSummary(dir);
  EXPECT_EQ(read.stoppedBecause, written.stoppedBecause);
  EXPECT_EQ(read.idleTools, written.idleTools);
  EXPECT_EQ(numbersOf(read), numbersOf(written));
  EXPECT_EQ(numbersOf(read).at("seconds"), 1.0 / 3.0);
  EXPECT_EQ(numbersOf(read).at("iterations"), std::exp2(40));
  ASSERT_EQ(read.doubts.size(), 2u);
  EXPECT_EQ(read.doubts[0].detail, "at worst: 0.01");
  EXPECT_EQ(read.doubts[1].firstTime, 1.0 / 3.0);
  EXPECT_EQ(read.reactions.front().force, written.reactions.front().force);
  writeSummary(dir, read);
  EXPECT_EQ(contents(dir / "summary.yaml"), text) << "all entries are written and read";
  std::ofstream(dir / "summary.yaml") << "program: [";
  expectError([&] { readSummary(dir); }, "summary.yaml");
  std::ofstream(dir / "summary.yaml") << "program: p\ndoubts: [{what: w, steps: 3}]\n";
  expectError([&] { readSummary(dir); }, "first_time");
  std::ofstream(dir / "summary.yaml") << "steps: 3\n";
  expectError([&] { readSummary(dir); }, "is not the summary of a run");
  removeSummary(dir);
  expectError([&] { readSummary(dir); }, "summary.yaml");
}

TEST_F(Results, SummariesLeaveOutWhatThereIsNot) {
  RunAccount account;
  account.program = "burnish 0";
  account.completed = true;
  account.reactions = {{"floor", "bottom", {0.0, -1.0}, {}, 2.5, 0.1}};
  writeSummary(dir, account);
  const std::string text = contents(dir / "summary.yaml");
  for (const char* absent : {"stopped_because", "advice", "doubts", "warnings", "idle_tools",
                             "rezonings:", "rezoning_failure", "von_mises_minimum", "stabilised_share"})
    EXPECT_EQ(text.find(absent), std::string::npos) << absent;
  EXPECT_NE(text.find("  - {support: floor, place: bottom, force: [0, -1], moment: [], largest: 2.5, "
                      "largest_time: 0.1}\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("\nrezonings_failed: 0\n"), std::string::npos);
}

/// Visitor that lists the names of all entries, those of records among them.
class NameCollector {
 public:
  template <class T>
  void field(const char* key, T& /*value*/, const Rule& /*rule*/, const char* /*sentence*/) {
    names.emplace_back(key);
    if constexpr (requires(typename T::value_type item) { describe(*this, item); }) {
      typename T::value_type item;
      describe(*this, item);
    }
  }

  std::vector<std::string> names;
};

TEST_F(Results, EveryEntryOfASummaryIsDocumented) {
  const std::string page = contents(fs::path(BURNISH_SOURCE_DIR) / "docs/results.md");
  NameCollector collector;
  RunAccount account;
  describe(collector, account);
  EXPECT_GT(collector.names.size(), 50u);
  for (const std::string& name : collector.names)
    EXPECT_NE(page.find("`" + name + "`"), std::string::npos) << name;
}

TEST_F(Results, SummariesOfNewerVersionsAreRead) {
  writeSummary(dir, fullAccount());
  std::ofstream(dir / "summary.yaml", std::ios::app)
      << "mood: calm\nplaces: [here, there]\nwind: {from: west, force: 3}\nnothing: ~\nheight: 12\n";
  const RunAccount read = readSummary(dir);
  EXPECT_EQ(read.advice, "take more steps");
  EXPECT_EQ(numbersOf(read), numbersOf(fullAccount()));
}

TEST_F(Results, EqualRecordsGiveEqualBytes) {
  writeSample(dir / "a", 1);
  writeSample(dir / "b", 1);
  EXPECT_EQ(contents(dir / "a/result.h5"), contents(dir / "b/result.h5"));
  EXPECT_EQ(contents(dir / "a/result/frame_000000.h5"), contents(dir / "b/result/frame_000000.h5"));
}

TEST_F(Results, AnyHdf5ProgramFindsTheDocumentedLayout) {
  writeSample(dir, 1);
  const hid_t file = H5Fopen((dir / "result/frame_000000.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  const hid_t stress = H5Dopen2(file, "/fields/stress", H5P_DEFAULT);
  const hid_t space = H5Dget_space(stress);
  hsize_t shape[2] = {0, 0};
  ASSERT_EQ(H5Sget_simple_extent_dims(space, shape, nullptr), 2);
  EXPECT_EQ(shape[0], 25u);
  EXPECT_EQ(shape[1], 4u);
  std::vector<double> values(100);
  ASSERT_GE(H5Dread(stress, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
  EXPECT_EQ(values[4 * 7 + 2], numbers(4, 25, 3)(2, 7));
  EXPECT_GT(H5Aexists_by_name(file, "/fields/stress", "components", H5P_DEFAULT), 0);
  EXPECT_GT(H5Lexists(file, "/contact/0/average_gap", H5P_DEFAULT), 0);
  EXPECT_GT(H5Lexists(file, "/quadrature/fields/pressure", H5P_DEFAULT), 0);
  H5Sclose(space);
  H5Dclose(stress);
  H5Fclose(file);
}

/// A child writes one run after the other into the same directory, each with its own title and frames, and
/// reports what it has finished; it is killed at a random moment. Whatever is visible then must be whole, of
/// one run, and must contain everything that was reported.
TEST_F(Results, SurviveAKillAtAnyMoment) {
  std::mt19937 random(7);
  int framesSeen = 0, kills = 30;
  for (int kill = 0; kill < kills; ++kill) {
    int report[2];
    ASSERT_EQ(::pipe(report), 0);
    const pid_t child = ::fork();
    if (child == 0) {
      for (int run = 0;; ++run) {
        const ModelRecord model = sampleModel(4 + run % 3, std::to_string(run));
        ResultWriter writer(dir, model);
        for (int i = 0; i < 6; ++i) {
          writer.append(sampleFrame(model, i, 2000));
          const int done[2] = {run, i + 1};
          if (::write(report[1], done, sizeof done) != sizeof done) ::_exit(1);
        }
      }
    }
    ::close(report[1]);
    int done[2] = {0, 0};
    ASSERT_EQ(::read(report[0], done, sizeof done), static_cast<ssize_t>(sizeof done));
    ::usleep(std::uniform_int_distribution<unsigned>(0, 60'000)(random));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    while (::read(report[0], done, sizeof done) > 0) continue;
    ::close(report[0]);

    if (!fs::exists(dir / "result.h5")) continue;  // killed while the earlier run was being replaced
    const ResultReader reader(dir);
    const int run = std::stoi(reader.model().title);
    ASSERT_TRUE(run == done[0] || run == done[0] + 1) << run << " after " << done[0];
    const ModelRecord model = sampleModel(4 + run % 3, std::to_string(run));
    EXPECT_TRUE(same(reader.model(), model));
    if (run == done[0]) {
      EXPECT_GE(reader.numFrames(), done[1]);
    }
    for (int i = 0; i < reader.numFrames(); ++i)
      ASSERT_TRUE(same(reader.frame(i), sampleFrame(model, i, 2000))) << "kill " << kill << ", frame " << i;
    framesSeen += reader.numFrames();
  }
  EXPECT_GT(framesSeen, kills);
}

TEST_F(Results, AreReadableWhileTheRunGoesOn) {
  const ModelRecord model = sampleModel();
  ResultWriter writer(dir, model);
  const ResultReader early(dir);
  EXPECT_EQ(early.numFrames(), 0);
  expectError([&] { early.frame(0); }, "has no frames yet");
  for (int i = 0; i < 3; ++i) {
    writer.append(sampleFrame(model, i));
    EXPECT_TRUE(same(ResultReader(dir).frame(i), sampleFrame(model, i)));
  }
  expectError([&] { ResultReader(dir).frame(3); }, "its frames are 0 to 2");
}

/// The limit on the size of a file stands in for a full disk: both end a write() short and refuse the next
/// one.
TEST_F(Results, AFullDiskIsAnErrorAndLeavesTheEarlierFrames) {
  const ModelRecord model = sampleModel();
  const int code = exitCodeOf([&] {
    ResultWriter writer(dir, model);
    writer.append(sampleFrame(model, 0));
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{.rlim_cur = 20'000, .rlim_max = 20'000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    const std::string message = messageOf([&] { writer.append(sampleFrame(model, 1, 10'000)); });
    const std::string expected = (dir / "result/frame_000001.h5").string();
    return message.find("cannot write " + expected) == 0 ? 0 : 1;
  });
  EXPECT_EQ(code, 0);
  EXPECT_EQ(ResultReader(dir).numFrames(), 1);
  EXPECT_TRUE(same(ResultReader(dir).frame(0), sampleFrame(model, 0)));
  EXPECT_EQ(std::distance(fs::directory_iterator(dir / "result"), fs::directory_iterator()), 1);
}

TEST_F(Results, ANewRunReplacesTheOldOneAndNothingElse) {
  writeSample(dir, 5);
  overwrite(dir / "notes.txt", "mine");
  overwrite(dir / "result/frame_1.h5", "mine");
  overwrite(dir / "result/frame_000005.h5.partial", "left by a killed run");
  writeSample(dir, 2);
  EXPECT_EQ(ResultReader(dir).numFrames(), 2);
  EXPECT_FALSE(fs::exists(dir / "result/frame_000002.h5"));
  EXPECT_FALSE(fs::exists(dir / "result/frame_000005.h5.partial"));
  EXPECT_EQ(contents(dir / "notes.txt"), "mine");
  EXPECT_EQ(contents(dir / "result/frame_1.h5"), "mine");
}

TEST_F(Results, ForeignFilesAreNotOverwritten) {
  overwrite(dir / "result.h5", "somebody's data");
  expectError([&] { writeSample(dir, 1); }, "result.h5 is not a readable HDF5 file");
  EXPECT_EQ(contents(dir / "result.h5"), "somebody's data");

  writeSample(dir / "run", 2);
  RunAccount summary;
  summary.program = "burnish 0 (engine 0)";
  summary.completed = true;
  writeSummary(dir / "run", summary);
  overwrite(dir / "run/result/frame_000001.h5", "somebody's data");
  expectError([&] { writeSample(dir / "run", 1); }, "frame_000001.h5 is not a readable HDF5 file");
  EXPECT_EQ(ResultReader(dir / "run").numFrames(), 2);
  EXPECT_TRUE(readSummary(dir / "run").completed);
}

TEST_F(Results, OnlyOneRunWritesToADirectory) {
  const ModelRecord model = sampleModel();
  ResultWriter writer(dir, model);
  writer.append(sampleFrame(model, 0));
  expectError([&] { ResultWriter(dir, model); }, "another run is writing its result");
  EXPECT_EQ(ResultReader(dir).numFrames(), 1);
}

TEST_F(Results, UnwritablePlacesAreErrors) {
  overwrite(dir / "file", "");
  expectError([&] { writeSample(dir / "file/run", 0); }, "cannot create the directory");
  expectError([&] { writeSample("/proc/burnish", 0); }, "cannot create the directory /proc/burnish");
}

TEST_F(Results, ThingsThatAreNoResultAreRefused) {
  overwrite(dir / "text.h5", "not HDF5");
  overwrite(dir / "empty.h5", "");
  const hid_t foreign = H5Fcreate((dir / "foreign.h5").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  H5Fclose(foreign);
  writeSample(dir / "run", 1);
  expectError([&] { ResultReader(dir / "nowhere"); }, "there is no such file or directory");
  expectError([&] { ResultReader reader(dir); }, "holds no result.h5; give the directory of a run");
  expectError([&] { ResultReader(dir / "text.h5"); }, "is not a readable HDF5 file");
  expectError([&] { ResultReader(dir / "empty.h5"); }, "is not a readable HDF5 file");
  expectError([&] { ResultReader(dir / "foreign.h5"); }, "no result of burnish");
  expectError([&] { ResultReader(dir / "run/result/frame_000000.h5"); }, "is the frame file of a result");
}

TEST_F(Results, AnotherFormatIsRefused) {
  writeSample(dir, 0);
  const hid_t file = H5Fopen((dir / "result.h5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t attribute = H5Aopen(file, "burnish_format", H5P_DEFAULT);
  const int format = 3;
  ASSERT_GE(H5Awrite(attribute, H5T_NATIVE_INT, &format), 0);
  H5Aclose(attribute);
  H5Fclose(file);
  expectError([&] { ResultReader reader(dir); }, "has result format 3, but this program reads format 2");
}

TEST_F(Results, FramesOfAnotherRunAreRefused) {
  writeSample(dir / "a", 2);
  const ModelRecord other = sampleModel(4, "another title");
  ResultWriter(dir / "b", other).append(sampleFrame(other, 0));
  fs::copy_file(dir / "b/result/frame_000000.h5", dir / "a/result/frame_000001.h5",
                fs::copy_options::overwrite_existing);
  expectError([&] { ResultReader(dir / "a").frame(1); }, "belongs to another run");
  expectError([&] { ResultReader(dir / "a").times(); }, "belongs to another run");
  fs::copy_file(dir / "a/result/frame_000000.h5", dir / "a/result/frame_000001.h5",
                fs::copy_options::overwrite_existing);
  expectError([&] { ResultReader(dir / "a").frame(1); }, "holds frame 0 instead of 1");
}

TEST_F(Results, TruncatedFilesAreRefused) {
  writeSample(dir, 1);
  for (const fs::path& path : {dir / "result.h5", dir / "result/frame_000000.h5"}) {
    const std::string whole = contents(path);
    for (std::size_t size = 0; size < whole.size(); size += 211) {
      overwrite(path, whole.substr(0, size));
      EXPECT_NE(messageOf([&] { ResultReader(dir).frame(0); }), "") << path << " cut to " << size;
    }
    overwrite(path, whole);
  }
  EXPECT_EQ(messageOf([&] { ResultReader(dir).frame(0); }), "");
}

/// Every piece of the file has a checksum: a changed byte is an error, or it lies where nothing is stored.
TEST_F(Results, ChangedBytesNeverChangeWhatIsRead) {
  const ModelRecord model = sampleModel();
  const FrameRecord frame = sampleFrame(model, 0, 1500);
  ResultWriter(dir, model).append(frame);
  int refused = 0, harmless = 0;
  for (const fs::path& path : {dir / "result.h5", dir / "result/frame_000000.h5"}) {
    const std::string whole = contents(path);
    for (std::size_t i = 0; i < whole.size(); i += 53) {
      std::string changed = whole;
      changed[i] = static_cast<char>(changed[i] ^ (1 << (i % 8)));
      overwrite(path, changed);
      try {
        const ResultReader reader(dir);
        if (reader.numFrames() == 1) {
          EXPECT_TRUE(same(reader.model(), model) && same(reader.frame(0), frame)) << path << " byte " << i;
        }
        ++harmless;
      } catch (const Error&) {
        ++refused;
      }
    }
    overwrite(path, whole);
  }
  EXPECT_GT(refused, 10 * harmless / 4) << harmless;
}

TEST_F(Results, ADatasetLargerThanItsFileIsRefused) {
  writeSample(dir, 1);
  const hid_t file = H5Fopen((dir / "result/frame_000000.h5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  ASSERT_GE(H5Ldelete(file, "displacement", H5P_DEFAULT), 0);
  const hsize_t shape[2] = {hsize_t{1} << 30, 2};
  const hid_t space = H5Screate_simple(2, shape, nullptr);
  const hid_t dataset =
      H5Dcreate2(file, "displacement", H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  ASSERT_GE(dataset, 0);
  H5Dclose(dataset);
  H5Sclose(space);
  H5Fclose(file);
  expectError([&] { ResultReader(dir).frame(0); }, "claims more data than the file can hold");
}

/// A file that another program has spoilt, so that its checksums are right.
TEST_F(Results, AMeshThatDoesNotFitItsFrameIsRefused) {
  const auto refused = [&](const std::function<void(hid_t file)>& spoil, const std::string& part) {
    const ModelRecord model = sampleModel();
    ResultWriter(dir, model).append(frameOnNewMesh(model, 0, 6));
    const fs::path path = dir / "result/frame_000000.h5";
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    spoil(file);
    H5Fclose(file);
    expectError([&] { ResultReader(dir).frame(0); }, path.string() + part);
  };
  const auto setNodes = [](hid_t file, int nodes) {
    ASSERT_GE(H5Adelete_by_name(file, "mesh", "num_nodes", H5P_DEFAULT), 0);
    const hid_t space = H5Screate(H5S_SCALAR);
    const hid_t attribute = H5Acreate_by_name(file, "mesh", "num_nodes", H5T_STD_I32LE, space, H5P_DEFAULT,
                                              H5P_DEFAULT, H5P_DEFAULT);
    EXPECT_GE(H5Awrite(attribute, H5T_NATIVE_INT, &nodes), 0);
    H5Aclose(attribute);
    H5Sclose(space);
  };
  const auto remove = [](hid_t file, const char* name) { ASSERT_GE(H5Ldelete(file, name, H5P_DEFAULT), 0); };
  refused([&](hid_t file) { setNodes(file, 46); }, ": displacements of 2 components at 45 nodes; its mesh");
  refused([&](hid_t file) { setNodes(file, 36); }, ", mesh, patch 1: a node is not between 0 and 35");
  refused([&](hid_t file) { remove(file, "mesh/patches/0/weights"); },
          "/mesh/patches/0: dataset weights is missing");
  refused([&](hid_t file) { remove(file, "mesh/patches"); }, "/mesh: group patches is missing");
  refused([&](hid_t file) { remove(file, "mesh"); }, ": displacements of 2 components at 45 nodes");
}

TEST_F(Results, ContradictoryModelsAreRefused) {
  const auto refused = [&](const std::function<void(ModelRecord&)>& spoil, const std::string& part) {
    ModelRecord model = sampleModel();
    spoil(model);
    expectError([&] { ResultWriter(dir, model); }, part);
    EXPECT_FALSE(fs::exists(dir / "result.h5"));
  };
  refused([](auto& m) { m.dim = 3; }, "2 parametric directions in 3 dimensions");
  refused([](auto& m) { m.mesh.numNodes = 24; }, "a node is not between 0 and 23");
  refused([](auto& m) { m.mesh.patches[0].nodes[3] = -1; }, "a node is not between");
  refused([](auto& m) { m.mesh.patches[1].weights(4) = 0.0; }, "a weight is not positive");
  refused([](auto& m) { m.mesh.patches[1].weights.conservativeResize(8); }, "9 control points, 8 weights");
  refused([](auto& m) { m.mesh.patches[0].points(1, 1) = std::nan(""); }, "a control point is not finite");
  refused([](auto& m) { m.mesh.patches[0].points.conservativeResize(3, 16); },
          "control points with 3 coordinates");
  refused([](auto& m) { m.mesh.patches[0].directions[1].knots.back() = 0.5; },
          "patch 0, direction 1: knot vector: knot 7");
  refused([](auto& m) { m.mesh.patches[0].directions[1].degree = 1000; }, "degree 1000");
  refused([](auto& m) { m.mesh.patches.clear(); }, "without patches");
  refused([](auto& m) { m.tools[1].until = std::nan(""); },
          "a time at which the tool \"ball\" is taken away that is not finite");
  refused([](auto& m) { m.mesh.patches[1].body = 1; }, "a patch of body 1, which is none of the model's");
  refused([](auto& m) { m.bodies = {"block", "punch"}; }, "the body \"punch\" has no patch");
  refused(
      [](auto& m) {
        m.tools[0].shape = Sphere{{0.0, 0.0, 0.0}, -1.0};
      },
      "the shape of the tool \"cylinder\"");
}

TEST_F(Results, ContradictoryFramesAreRefused) {
  const ModelRecord model = sampleModel();
  ResultWriter writer(dir, model);
  const auto refused = [&](const std::function<void(FrameRecord&)>& spoil, const std::string& part) {
    FrameRecord frame = sampleFrame(model, 0);
    spoil(frame);
    expectError([&] { writer.append(frame); }, part);
  };
  refused([](auto& f) { f.index = 1; }, "index 1 was to be appended to 0 frames");
  refused([](auto& f) { f.displacement.conservativeResize(2, 24); }, "2 components at 24 nodes");
  refused([](auto& f) { f.displacement(0, 0) = std::numeric_limits<double>::infinity(); }, "not finite");
  refused([](auto& f) { f.toolDisplacement.conservativeResize(2, 2); }, "2 displacements of tools");
  refused([](auto& f) { f.fields["stress"].components.pop_back(); },
          "field stress has 4 rows for 3 components");
  refused([](auto& f) { f.fields["stress"].values.conservativeResize(4, 26); }, "26 values for 25 nodes");
  refused([](auto& f) { f.fields["a/b"] = f.fields["stress"]; }, "\"a/b\" cannot be the name of a field");
  refused([](auto& f) { f.contact[0].nodes[1] = 25; }, "contact 0: a node is not between 0 and 24");
  refused([](auto& f) { f.contact[0].active.pop_back(); },
          "3 nodes, but 3 pressures, 3 average gaps and 2 states");
  refused([](auto& f) { f.contact[0].tool = "hammer"; }, "the tool \"hammer\" is none of the model's");
  refused([](auto& f) { f.contact[0].patch = 2; }, "patch 2 of 2");
  refused([](auto& f) { f.fields["stress"].bodies = {"anvil"}; },
          "field stress is of the body \"anvil\", which is none of the model's");
  refused([](auto& f) { f.quadrature.numPoints = {12}; },
          "12 quadrature points, which are not those of 0 bodies");
  refused([](auto& f) { f.contact[0].quadratureGap.conservativeResize(4); },
          "5 quadrature points, but 5 pressures, 4 gaps");
  refused([](auto& f) { f.quadrature.positions.conservativeResize(2, 3); },
          "12 values for 3 quadrature points");
  const auto refusedAnew = [&](const std::function<void(FrameRecord&)>& spoil, const std::string& part) {
    FrameRecord frame = frameOnNewMesh(model, 0, 6);
    spoil(frame);
    expectError([&] { writer.append(frame); }, part);
  };
  refusedAnew([](auto& f) { f.mesh.reset(); }, "2 components at 45 nodes; its mesh has 2 dimensions and 25");
  refusedAnew([](auto& f) { f.displacement.conservativeResize(2, 25); },
              "2 components at 25 nodes; its mesh has 2 dimensions and 45");
  refusedAnew([](auto& f) { f.fields["stress"].values.conservativeResize(4, 25); }, "25 values for 45 nodes");
  refusedAnew([](auto& f) { f.contact[0].nodes[1] = 45; }, "contact 0: a node is not between 0 and 44");
  refusedAnew([](auto& f) { f.mesh->patches.pop_back(), f.contact[0].patch = 1; }, "patch 1 of 1");
  refusedAnew([](auto& f) { f.mesh->patches[1].weights(2) = 0.0; },
              "mesh, patch 1: a weight is not positive");
  refusedAnew([](auto& f) { f.mesh->patches.clear(); }, "a mesh without patches");
  EXPECT_EQ(ResultReader(dir).numFrames(), 0);
}

TEST_F(Results, HistoryReadsBackExactly) {
  HistoryWriter writer(dir / "history.csv", {"step", "time", "cylinder.fx"});
  const std::vector<std::vector<double>> rows = {{0.0, 0.1, -1.0 / 3.0}, {1.0, 1e-300, 123456789.125}};
  for (const auto& row : rows) {
    writer.append(row);
    const HistoryTable table = readHistory(dir / "history.csv");
    EXPECT_EQ(table.columns, (std::vector<std::string>{"step", "time", "cylinder.fx"}));
    for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(table.values[c].back(), row[c]);
  }
  EXPECT_EQ(contents(dir / "history.csv"),
            "step,time,cylinder.fx\n0,0.1,-0.3333333333333333\n1,1e-300,123456789.125\n");
  const HistoryTable table = readHistory(dir / "history.csv");
  EXPECT_EQ(table.numRows(), 2u);
  EXPECT_EQ(table.column("time"), (std::vector<double>{0.1, 1e-300}));
  expectError([&] { table.column("fy"); },
              "there is no column \"fy\"; its columns are step, time, cylinder.fx");
}

TEST_F(Results, HistoryLeavesOutARowThatIsBeingWritten) {
  for (const char* ofRun : {"history.csv", "convergence.csv"}) {
    overwrite(dir / ofRun, "a,b\n1,2\n3,4");
    EXPECT_EQ(readHistory(dir / ofRun).numRows(), 1u);
  }
  overwrite(dir / "table.csv", "a,b\n1,2\n3,4");
  EXPECT_EQ(readHistory(dir / "table.csv").column("b"), (std::vector<double>{2.0, 4.0}));
  overwrite(dir / "table.csv", "a,b\n1,2\n ");
  EXPECT_EQ(readHistory(dir / "table.csv").numRows(), 1u);
  overwrite(dir / "spreadsheet.csv",
            "\xEF\xBB\xBF"
            "a,b\r\n1,2");
  EXPECT_EQ(readHistory(dir / "spreadsheet.csv").column("a"), std::vector<double>{1.0});
  overwrite(dir / "windows.csv", "a,b\r\n1,2\r\n");
  EXPECT_EQ(readHistory(dir / "windows.csv").column("b"), std::vector<double>{2.0});
}

TEST_F(Results, TablesOfOthersMayHaveQuotes) {
  overwrite(dir / "table.csv", "\"a\",\"b, all\"\r\n1,2\r\n\"3\", \"4\"\r\n");
  const HistoryTable table = readHistory(dir / "table.csv");
  EXPECT_EQ(table.columns, (std::vector<std::string>{"a", "b, all"}));
  EXPECT_EQ(table.column("b, all"), (std::vector<double>{2.0, 4.0}));
  overwrite(dir / "table.csv", "a,\"\"\n");
  expectError([&] { readHistory(dir / "table.csv"); }, "table.csv: column 2 has no name");
}

TEST_F(Results, BadHistoriesAreRefusedWithTheirPlace) {
  overwrite(dir / "h.csv", "a,b\n1,2\n3,four\n");
  expectError([&] { readHistory(dir / "h.csv"); }, "h.csv:3: \"four\" in the column b is not a number");
  overwrite(dir / "h.csv", "a,b\n1,2,3\n");
  expectError([&] { readHistory(dir / "h.csv"); }, "h.csv:2: 3 values instead of 2");
  overwrite(dir / "h.csv", "a,a\n");
  expectError([&] { readHistory(dir / "h.csv"); }, "the column \"a\" stands twice");
  overwrite(dir / "h.csv", "");
  expectError([&] { readHistory(dir / "h.csv"); }, "is empty where a header was expected");
  expectError([&] { readHistory(dir / "none.csv"); }, "there is no such file");
  expectError([&] { HistoryWriter(dir / "h.csv", {"a,b"}); }, "cannot be the name of a column");
  expectError([&] { HistoryWriter(dir / "none/h.csv", {"a"}); }, "cannot write");
}

}  // namespace
}  // namespace burnish
