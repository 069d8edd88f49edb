#include "postproc/text/account_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace burnish {
namespace {

using testing::ElementsAre;

std::string lineOf(const RunAccount& account, const HistoryTable& history, const std::string& name) {
  for (const auto& [label, text] : accountLines(account, history))
    if (label == name) return text;
  return {};
}

/// Of two rows.
HistoryTable historyOf(double strainEnergy, double plasticWork, double externalWork) {
  return {.path = "history.csv",
          .columns = {"time", "strain_energy", "contact_energy", "plastic_work", "external_work"},
          .values = {{0.0, 1.0}, {0.0, strainEnergy}, {0.0, 0.0}, {0.0, plasticWork}, {0.0, externalWork}}};
}

TEST(AccountText, SaysHowWellWorkIsBalanced) {
  RunAccount account;
  EXPECT_EQ(lineOf(account, historyOf(2.0, 6.0, 8.04), "balance"),
            "external work differs by 0.5 % from energies and plastic work; doubtful above 10 %");
  EXPECT_EQ(lineOf(account, historyOf(0.0, 0.0, 0.0), "balance"), "nothing stored, no work done");
  account.stabilisationWork = 0.04;
  account.stabilisedShare = account.largestStabilisedShare = 0.0;
  EXPECT_EQ(lineOf(account, historyOf(2.0, 6.0, 8.04), "balance"),
            "external work differs by 0 % from energies and plastic work; doubtful above 10 %");
  EXPECT_EQ(lineOf(account, {}, "balance"), "") << "of a history that is lost";
}

TEST(AccountText, EnergiesAreShownWithoutRoundingErrors) {
  HistoryTable history = historyOf(2.0, 6.0, 8.04);
  EXPECT_EQ(lineOf({}, history, "energies at the end"), "strain 2, contact 0, plastic work 6");
  history.values[2] = {0.3, -4.8e-281};  // of a tool that has been taken off
  EXPECT_EQ(lineOf({}, history, "energies at the end"), "strain 2, contact 0, plastic work 6");
  history.values[2] = {0.3, -1e-9};
  EXPECT_EQ(lineOf({}, history, "energies at the end"), "strain 2, contact -1e-09, plastic work 6");
}

TEST(AccountText, WarnsWithTimeAndShareAndNamesIdleTools) {
  RunAccount account;
  account.steps = 220;
  account.doubts = {{"smallest J below 0.05", 1.25, 55, "at worst 0.01"}};
  account.idleTools = {"disc"};
  EXPECT_THAT(warningsOf(account),
              ElementsAre("smallest J below 0.05: first at t = 1.25, in 25.0 % of the steps; at worst 0.01",
                          "tool 'disc' has never touched the body"));
}

TEST(AccountText, ReactionsAreShownWithoutRoundingErrors) {
  EXPECT_EQ(reactionText({"floor", "bottom", {1e-15, -3.57}, {}, 3.57, 1.0}),
            "force of the body on face bottom: (0, -3.57), largest 3.57 at t = 1");
}

TEST(AccountText, SaysWhatMultigridNeeded) {
  RunAccount account;
  EXPECT_EQ(lineOf(account, {}, "linear systems"), "") << "of factors";
  account.linearIterations = 125;
  account.linearSystems = 20;
  account.linearSetUps = 12;
  account.linearFallbacks = 0;
  EXPECT_EQ(lineOf(account, {}, "linear systems"),
            "20 by multigrid, 6.2 iterations in each, set up 12 times");
  account.linearFallbacks = 2;
  EXPECT_EQ(lineOf(account, {}, "linear systems"),
            "20 by multigrid, 6.2 iterations in each, set up 12 times; 2 of them by factors in the end");
}

TEST(AccountText, TimingsAddUp) {
  RunAccount account;
  account.timings = {.assembly = 1.0, .contact = 2.0, .factorisation = 3.0, .output = 0.5, .total = 8.0};
  double sum = 0.0;
  for (const auto& [part, seconds] : timingsTable(account)) sum += seconds;
  EXPECT_DOUBLE_EQ(sum, 8.0);
  EXPECT_EQ(timingsTable(account).back(), std::make_pair(std::string("everything else"), 1.5));
}

}  // namespace
}  // namespace burnish
