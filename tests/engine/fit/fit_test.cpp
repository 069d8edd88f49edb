#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/fit/law_fit.h"
#include "engine/fit/separable_fit.h"
#include "engine/material/material.h"
#include "tests/message_of.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const fs::path kTreloar = fs::path(BURNISH_SOURCE_DIR) / "scenes/fits/treloar.csv";

LawFit fitOf(const std::string& name, const std::vector<MeasuredCurve>& curves, FitOptions options = {}) {
  for (const FittableLaw& law : fittableLaws())
    if (law.name == name) {
      if (options.terms == 0) options.terms = law.usualTerms;
      return law.fit(curves, options);
    }
  throw std::invalid_argument(name);
}

/// The numbers behind a key of the YAML, wherever it stands.
std::vector<double> constants(const LawFit& fit, const std::string& key) {
  std::vector<double> numbers;
  const std::string start = " " + key + ": ";
  for (std::size_t at = fit.yaml.find(start); at != std::string::npos; at = fit.yaml.find(start, at + 1)) {
    std::string text = fit.yaml.substr(at + start.size());
    text = text.substr(0, text.find('\n'));
    for (char& c : text)
      if (c == '[' || c == ']' || c == ',') c = ' ';
    std::istringstream words(text);
    for (double number; words >> number;) numbers.push_back(number);
  }
  return numbers;
}

/// Six digits, as the reference has them.
auto near(double value) {
  return testing::DoubleNear(value, 6e-6 * std::abs(value));
}

class TreloarFit : public testing::Test {
 protected:
  const std::vector<MeasuredCurve> curves_ = readRubberCurves({kTreloar}, {});
};

TEST_F(TreloarFit, ReadsBothTests) {
  ASSERT_EQ(curves_.size(), 2U);
  EXPECT_EQ(curves_[0].name, "uniaxial");
  EXPECT_EQ(curves_[0].x.size(), 24U);
  EXPECT_EQ(curves_[1].name, "equibiaxial");
  EXPECT_EQ(curves_[1].x.size(), 16U);
}

/// The constants and errors of an independent program (relative residuals, both tests at once).
TEST_F(TreloarFit, HasTheConstantsOfMooneyAndRivlin) {
  const LawFit fit = fitOf("mooney-rivlin", curves_);
  EXPECT_THAT(constants(fit, "C10"), ElementsAre(near(1.96692)));
  EXPECT_THAT(constants(fit, "C01"), ElementsAre(near(0.0285266)));
  EXPECT_NEAR(fit.rms, 0.227, 0.0005);
}

TEST_F(TreloarFit, HasTheConstantsOfYeoh) {
  const LawFit fit = fitOf("yeoh", curves_);
  EXPECT_THAT(constants(fit, "C10"), ElementsAre(near(1.94690)));
  EXPECT_THAT(constants(fit, "C20"), ElementsAre(near(-0.0158021)));
  EXPECT_THAT(constants(fit, "C30"), ElementsAre(near(4.14767e-4)));
  EXPECT_NEAR(fit.rms, 0.120, 0.0005);
}

TEST_F(TreloarFit, FindsTheBestConstantsOfOgdenAmongMany) {
  const LawFit fit = fitOf("ogden", curves_);
  EXPECT_THAT(constants(fit, "mu"), ElementsAre(near(-0.0702585), near(6.19971), near(0.00540624)));
  EXPECT_THAT(constants(fit, "alpha"), ElementsAre(near(-2.18394), near(1.30864), near(5.46505)));
  EXPECT_NEAR(fit.rms, 0.0574, 0.00005);
  EXPECT_THAT(fit.warnings, IsEmpty());
}

/// More terms cannot fit worse.
TEST_F(TreloarFit, ErrorsFallWithTheTerms) {
  double before = 1.0;
  for (int terms = 1; terms <= 4; ++terms) {
    const LawFit fit = fitOf("ogden", curves_, {.terms = terms});
    EXPECT_LT(fit.rms, before) << terms;
    before = fit.rms;
  }
}

TEST_F(TreloarFit, SaysWhatItIsGoodFor) {
  const LawFit fit = fitOf("neo-hookean", curves_);
  const double mu = constants(fit, "E").at(0) / (2.0 * (1.0 + constants(fit, "nu").at(0)));
  EXPECT_THAT(fit.account, Contains(HasSubstr("initial shear modulus")));
  EXPECT_THAT(fit.account, Contains(HasSubstr("stable in all three tests")));
  EXPECT_NEAR(fit.value(RubberTest::Uniaxial, 2.0), mu * (2.0 - 0.25), 1e-6 * mu);
}

/// Each kind of residuals is smallest for the fit that makes it small.
TEST_F(TreloarFit, WeighsAsItIsTold) {
  const auto error = [&](const LawFit& fit, bool isRelative) {
    double sum = 0.0;
    for (const MeasuredCurve& curve : curves_)
      for (std::size_t k = 0; k < curve.x.size(); ++k)
        sum +=
            std::pow((fit.value(curve.test, curve.x[k]) - curve.y[k]) / (isRelative ? curve.y[k] : 64.4), 2);
    return sum;
  };
  const LawFit relative = fitOf("yeoh", curves_);
  const LawFit absolute = fitOf("yeoh", curves_, {.residuals = FitResiduals::Absolute});
  EXPECT_LT(error(absolute, false), error(relative, false));
  EXPECT_LT(error(relative, true), error(absolute, true));
  EXPECT_NEAR(absolute.rms, std::sqrt(error(absolute, false) / 40.0), 1e-6);
}

/// A law's own curve is fitted to its constants.
TEST(Fit, FindsTheConstantsThatTheCurvesAreMadeOf) {
  const Ogden ogden{{6.3, 0.012, -0.1}, {1.3, 5.0, -2.0}};
  const Yeoh yeoh{0.5, -0.02, 0.001};
  std::vector<MeasuredCurve> ofOgden, ofYeoh;
  for (const RubberTest test : kRubberTests) {
    MeasuredCurve a{wordOf(test), test, {}, {}}, b = a;
    for (double stretch = 0.5; stretch < 5.0; stretch += 0.35) {
      a.x.push_back(stretch);
      b.x.push_back(stretch);
      a.y.push_back(nominalStress(ogden, test, stretch));
      b.y.push_back(nominalStress(yeoh, test, stretch));
    }
    ofOgden.push_back(a);
    ofYeoh.push_back(b);
  }
  const LawFit fitted = fitOf("ogden", ofOgden);
  EXPECT_LT(fitted.rms, 1e-9);
  EXPECT_THAT(constants(fitted, "alpha"), ElementsAre(near(-2.0), near(1.3), near(5.0)));
  EXPECT_THAT(constants(fitted, "mu"), ElementsAre(near(-0.1), near(6.3), near(0.012)));
  EXPECT_THAT(constants(fitOf("yeoh", ofYeoh), "C20"), ElementsAre(near(-0.02)));
}

/// The nominal stresses are those of the closed forms.
TEST(RubberTests, AreThoseOfTheIncompressibleLimit) {
  const Ogden ogden{{6.3, 0.012, -0.1}, {1.3, 5.0, -2.0}};
  EXPECT_NEAR(nominalStress(ogden, RubberTest::Uniaxial, 3.0), 8.799261, 5e-7);
  EXPECT_NEAR(nominalStress(ogden, RubberTest::Equibiaxial, 3.0), 12.307049, 5e-7);
  EXPECT_NEAR(nominalStress(ogden, RubberTest::Planar, 3.0), 9.524275, 5e-7);
}

/// For C10 = 1, C20 = -0.05: P = 2 (λ − λ⁻²)(1 − 0.1 (λ² + 2/λ − 3)) has its maximum where its derivative
/// vanishes, found here on the closed form.
TEST(Fit, TellsWhereTheStressNoLongerGrows) {
  const Yeoh yeoh{1.0, -0.05, 0.0};
  MeasuredCurve curve{"uniaxial", RubberTest::Uniaxial, {}, {}};
  for (double stretch = 1.1; stretch < 1.8; stretch += 0.1) {
    curve.x.push_back(stretch);
    curve.y.push_back(nominalStress(yeoh, RubberTest::Uniaxial, stretch));
  }
  double low = 1.0, high = 3.0;
  const auto slope = [](double l) {
    const double w = 1.0 - 0.1 * (l * l + 2.0 / l - 3.0);
    return (1.0 + 2.0 / (l * l * l)) * w - (l - 1.0 / (l * l)) * 0.1 * (2.0 * l - 2.0 / (l * l));
  };
  for (int k = 0; k < 50; ++k) (slope(0.5 * (low + high)) > 0.0 ? low : high) = 0.5 * (low + high);
  const LawFit fit = fitOf("yeoh", {curve});
  EXPECT_THAT(fit.warnings,
              Contains(HasSubstr(fmt::format(
                  "uniaxial tension: beyond the stretch {:.4g} the stress no longer grows", low))));
  EXPECT_THAT(fit.account, Not(Contains(HasSubstr("stable"))));
}

class MeasuredFile : public testing::Test {
 protected:
  void SetUp() override {
    file_ =
        fs::temp_directory_path() /
        (std::string("burnish_") + testing::UnitTest::GetInstance()->current_test_info()->name() + ".csv");
  }
  void TearDown() override { fs::remove(file_); }

  const fs::path& write(const std::string& text) const {
    std::ofstream(file_) << text;
    return file_;
  }

  fs::path file_;
};

TEST_F(MeasuredFile, MayHaveStrainsAndOneModeForAll) {
  const auto curves =
      readRubberCurves({write("# a comment\n strain , nominal_stress\n0.5, 1\r\n\n1.0,2")}, {"biaxial"});
  ASSERT_EQ(curves.size(), 1U);
  EXPECT_EQ(curves[0].test, RubberTest::Equibiaxial);
  EXPECT_THAT(curves[0].x, ElementsAre(1.5, 2.0));
  EXPECT_THAT(curves[0].y, ElementsAre(1.0, 2.0));
}

TEST_F(MeasuredFile, MistakesHaveTheirPlace) {
  const std::string path = file_.string();
  const auto rubber = [&](const std::string& text, const std::vector<std::string>& modes = {"planar"}) {
    write(text);
    return messageOf([&] { readRubberCurves({file_}, modes); });
  };
  EXPECT_EQ(rubber("stretch,stress\n1,x\n"), path + ":2: column stress: found \"x\"; allowed: a number");
  EXPECT_EQ(rubber("stretch,stress\n1,2,3\n"),
            path + ":2: found 3 cells under 2 columns; allowed: one for each");
  EXPECT_EQ(rubber("strain,stress\n-1.5,2\n"),
            path + ":2: column strain: found a stretch of -0.5; allowed: a positive one");
  EXPECT_THAT(rubber("stretch,stress\n"), HasSubstr("holds no points"));
  EXPECT_THAT(rubber("a,b\n1,2\n"), HasSubstr("there is no column stretch or strain"));
  EXPECT_THAT(rubber("stretch,stress\n2,1\n", {}), HasSubstr("nothing says how the rubber was pulled"));
  EXPECT_THAT(rubber("stretch,stress\n2,1\n", {"plannar"}), HasSubstr("Did you mean \"planar\"?"));
  EXPECT_THAT(rubber("mode,stretch,stress\nuni,2,1\n", {}),
              HasSubstr(":2: column mode: found \"uni\"; allowed"));
  EXPECT_THAT(rubber("mode,stretch,stress\nplanar,2,1\n"), HasSubstr("leave one of them out"));
  EXPECT_THAT(messageOf([&] { readRubberCurves({"/nowhere.csv"}, {}); }), HasSubstr("no such file"));
  write("stretch,stress\n2,1\n3,2\n");
  EXPECT_THAT(messageOf([&] { fitOf("ogden", readRubberCurves({file_}, {"planar"})); }),
              HasSubstr("found 2 points for 6 constants"));
  write("stretch,stress\n2,-1\n3,-2\n");
  EXPECT_THAT(messageOf([&] { fitOf("neo-hookean", readRubberCurves({file_}, {"planar"})); }),
              HasSubstr("no constants that make sense"));
}

/// A tension test made of Voce's law: nominal values of the true stress σ(ep) at ln(1 + e) = ep + σ/E.
TEST_F(MeasuredFile, OfATensionTestIsConverted) {
  const VoceHardening voce = [] {
    VoceHardening law;
    law.sigma0 = 80.0;
    law.sigmaInf = 170.0;
    law.beta = 18.0;
    return law;
  }();
  constexpr double E = 70000.0;
  std::string plastic = "plastic_strain,true_stress\n", nominal = "strain,stress\n0,0\n0.0005,35\n";
  for (double ep = 0.0; ep < 0.3; ep += 0.005) {
    const double stress = voce.sigma_y(ep);
    const double lambda = std::exp(ep + stress / E);
    plastic += fmt::format("{},{}\n", ep, stress);
    nominal += fmt::format("{},{}\n", lambda - 1.0, stress / lambda);
  }
  const auto expectVoce = [](const std::vector<MeasuredCurve>& curves) {
    const LawFit fit = fitOf("voce", curves);
    EXPECT_THAT(constants(fit, "sigma0"), ElementsAre(near(80.0)));
    EXPECT_THAT(constants(fit, "sigma_inf"), ElementsAre(near(170.0)));
    EXPECT_THAT(constants(fit, "beta"), ElementsAre(near(18.0)));
    EXPECT_LT(fit.rms, 1e-9);
  };
  write(plastic);
  expectVoce(readFlowCurves({file_}, {}, 0.0));
  write(nominal);
  const auto converted = readFlowCurves({file_}, E, 0.002);
  expectVoce(converted);
  // Considère: the force is largest where dσ/dep = σ (but for the elastic strain), and the neck begins.
  const double neck = converted[0].x.back();
  EXPECT_NEAR(voce.slope(neck), voce.sigma_y(neck), 0.1 * voce.sigma_y(neck));
  EXPECT_GE(converted[0].x.front(), 0.002);
}

TEST(Fit, WarnsOfASaturationThatIsNotReached) {
  MeasuredCurve curve{"short", {}, {}, {}};
  for (double ep = 0.0; ep < 0.05; ep += 0.005) {
    curve.x.push_back(ep);
    curve.y.push_back(100.0 + 100.0 * (1.0 - std::exp(-5.0 * ep)));
  }
  EXPECT_THAT(fitOf("voce", {curve}).warnings, Contains(HasSubstr("before the stress saturates")));
}

/// σ_a = σ_y + Σ C/γ tanh(γΔ/2) with three back stresses, at three ranges of an independent program and more of the
/// same formula.
TEST_F(MeasuredFile, OfStableCyclesHasTheBackStresses) {
  const std::vector<std::pair<double, double>> parts{{1e5, 1000.0}, {2e4, 200.0}, {2e3, 10.0}};
  std::string table = "plastic_range,amplitude\n0.002,297.896881\n0.01,386.142011\n0.04,439.407994\n";
  for (double range = 2e-4; range < 0.5; range *= 1.4) {
    double amplitude = 200.0;
    for (const auto& [C, gamma] : parts) amplitude += C / gamma * std::tanh(0.5 * gamma * range);
    table += fmt::format("{},{}\n", range, amplitude);
  }
  write(table);
  const LawFit fit = fitOf("chaboche", readCyclicCurves({file_}), {.terms = 3});
  EXPECT_LT(fit.rms, 1e-8);
  EXPECT_THAT(constants(fit, "sigma0"), ElementsAre(near(200.0)));
  EXPECT_THAT(constants(fit, "recovery"),
              testing::UnorderedElementsAre(near(1000.0), near(200.0), near(10.0)));
  EXPECT_THAT(constants(fit, "modulus"),
              testing::UnorderedElementsAre(0.0, near(1e5), near(2e4), near(2e3)));  // 0: of the yield stress
  EXPECT_NEAR(fit.value({}, 0.01), 386.142011, 1e-5);
  EXPECT_THAT(fit.warnings, IsEmpty());
}

/// Variable projection on a curve of two exponentials, whatever the order of the starts.
TEST(SeparableFit, FindsFactorsAndShapes) {
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(30, 0.0, 3.0);
  SeparableModel model;
  model.numShapes = 2;
  model.starts = {0.1, 1.0, 10.0};
  model.functions = [&](const Eigen::VectorXd& rates) {
    Eigen::MatrixXd functions(x.size(), 2);
    for (int k = 0; k < 2; ++k) functions.col(k) = (-rates[k] * x.array()).exp().matrix();
    return functions;
  };
  model.admits = [](const Eigen::VectorXd&, const Eigen::VectorXd&) { return true; };
  const Eigen::VectorXd values = model.functions(Eigen::Vector2d(0.7, 4.0)) * Eigen::Vector2d(2.0, -1.0);
  const auto fit = fitSeparable(model, values, Eigen::VectorXd::Ones(30));
  ASSERT_TRUE(fit);
  EXPECT_LT(fit->rms(), 1e-12);
  EXPECT_NEAR(fit->shapes.minCoeff(), 0.7, 1e-9);
  EXPECT_NEAR(fit->shapes.maxCoeff(), 4.0, 1e-8);
  model.admits = [](const Eigen::VectorXd& factors, const Eigen::VectorXd&) {
    return factors.minCoeff() > 5.0;
  };
  EXPECT_FALSE(fitSeparable(model, values, Eigen::VectorXd::Ones(30)));
}

}  // namespace
}  // namespace burnish
