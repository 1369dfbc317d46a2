// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A synthetic bench: two engines at three sizes, one of them on two threads, one invalid timing, one crash, a
// part with two choices of an engine, one of them wrong, a spec longer than a line, and a baseline.
#pragma once

#include "validation/results/types.hpp"

namespace rigor::report::synthetic {

inline constexpr const char* kLengthySpec =
    "rigor:box_margin=0.05,broad_phase=wide_tree,contact_frequency=45,curved_joints=off,precision=f32,preset="
    "matched,reuse_distance=1e-3,solver=wide,speculative_distance=5e-3,substeps=5,velocity_iterations=0";

inline results::BenchCase benchCase(const std::string& engine, double size, std::int64_t threads,
                                    double seconds) {
    results::BenchCase c;
    c.id = engine + "-" + std::to_string(static_cast<int>(size)) + "-" + std::to_string(threads);
    c.part = "scene";
    c.name = "pyramid";
    c.engine = engine + ":preset=matched";
    c.sizeUnit = "bodies";
    c.size = size;
    c.threads = threads;
    c.operation = "step";
    c.command = "./rigor bench pyramid --engines " + engine;
    for (std::int64_t round = 0; round < 7; ++round) {
        results::BenchRepetition r;
        r.round = round;
        r.order = round;
        r.wall = 1.5 * seconds;
        r.cpu = seconds;
        r.samples = 100;
        r.ownMemoryKiB = 2048;
        r.peakMemoryKiB = 40960;
        if (round == 0) r.allocations = 3.0;
        r.counts = {{"contacts", 4.0 * size}, {"touching_pairs", size}};
        r.phases = {{"solve", 0.5 * seconds}};
        r.quality = {{"max_penetration", "m", 0.001, std::nullopt, 0.005, true}};
        c.repetitions.push_back(r);
    }
    auto& s = c.summary;
    s.repetitions = 6;
    s.clock = threads > 1 ? "wall" : "cpu";
    s.wall = 1.5 * seconds;
    s.cpu = seconds;
    s.low = 0.98 * (threads > 1 ? s.wall : s.cpu);
    s.high = 1.03 * (threads > 1 ? s.wall : s.cpu);
    s.converged = true;
    s.valid = true;
    return c;
}

inline results::Run makeBench() {
    results::Run run;
    run.suite = "bench";
    run.command = "./rigor bench pyramid --engines ode,rigor,";
    run.command += kLengthySpec;
    run.started = "2026-01-01T00:00:00Z";
    run.finished = "2026-01-01T01:00:00Z";
    run.environment = {
        {"cpu", "some cpu"}, {"caches", "L1d 48K, L2 1024K"}, {"load", "0.1"}, {"load_after", "1.0"}};
    run.engines = {{"ode", "ODE", "0.16", "f64", "", ""}, {"rigor", "Rigor", "0.1", "f64", "", ""}};
    run.bench.settings = {
        {"seed", "5"}, {"width", "0.05"}, {"build", "optimised"}, {"baseline", "runs/before"}};
    for (const double size : {55.0, 385.0, 1240.0}) {
        auto ode = benchCase("ode", size, 1, 2e-6 * size), rigor = benchCase("rigor", size, 1, 1e-6 * size);
        auto two = benchCase("rigor", size, 2, 1.1e-6 * size / 2.0);
        ode.summary.base = rigor.summary.base = two.summary.base = ode.id;
        ode.summary.ratio = 1.0;
        rigor.summary.ratio = 0.5;
        two.summary.ratio = 0.275;
        rigor.summary.ratioLow = 0.48;
        rigor.summary.ratioHigh = 0.53;
        for (const auto& c : {ode, rigor, two}) run.bench.cases.push_back(c);
    }
    auto bad = benchCase("bullet", 1240.0, 1, 1e-3);
    bad.summary.valid = false;
    bad.summary.reason = "max_penetration 0.02 m > 0.005";
    bad.repetitions[2].quality[0].value = 0.02;
    bad.repetitions[2].quality[0].ok = false;
    run.bench.cases.push_back(bad);
    auto dead = benchCase("<b>dead</b>", 55.0, 1, 1e-3);
    dead.summary = {};
    dead.summary.reason = "crashed: SIGSEGV";
    dead.repetitions.resize(1);
    dead.repetitions[0].outcome = "crashed";
    run.bench.cases.push_back(dead);
    auto lengthy = benchCase("rigor", 55.0, 1, 2e-5);
    lengthy.id = "lengthy";
    lengthy.engine = kLengthySpec;
    for (auto& r : lengthy.repetitions) r.counts.push_back({"asleep", 55.0});
    run.bench.cases.push_back(lengthy);
    auto part = benchCase("fcl", 1000.0, 1, 5e-5);
    part.id = "part";
    part.part = "broad_phase";
    part.name = "moving boxes";
    part.operation = "update";
    part.sizeUnit = "boxes";
    for (auto& r : part.repetitions) {
        r.counts = {{"boxes", 1000.0}, {"pairs", 480.0}, {"pairs_held", 500.0}};
        r.quality = {{"missed_pairs", "1", 0.0, std::nullopt, 0.0, true}};
    }
    auto quick = part, wrong = part;
    quick.id = "quick";
    quick.engine = "rigor:broad_phase=tree";
    quick.summary.cpu = 1e-7;
    quick.summary.low = 0.9e-7;
    quick.summary.high = 1.1e-7;
    wrong.id = "wrong";
    wrong.engine = "rigor:broad_phase=hash";
    wrong.summary.valid = false;
    wrong.summary.reason = "missed_pairs 3 > 0";
    for (auto& r : wrong.repetitions) {
        r.quality[0].value = 3.0;
        r.quality[0].ok = false;
    }
    for (const auto& c : {part, wrong, quick}) run.bench.cases.push_back(c);
    for (std::size_t i = 0; i < run.bench.cases.size(); ++i)
        run.bench.cases[i].position = static_cast<std::int64_t>(i);
    run.bench.changes = {{"rigor-55-1", 1e-3, 1.5e-3, 1.5, 1.4, 1.6, 1e-4, "slower", ""},
                         {"ode-55-1", 1e-3, 1e-3, 1.0, 0.97, 1.02, 0.8, "same", ""},
                         {bad.id, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0, "not compared", bad.summary.reason}};
    return run;
}

}  // namespace rigor::report::synthetic
