// OMPL's LazyPRM and RRTConnect on scenarios of an arm of two links; one evaluation is one configuration against one
// obstacle.
// usage: ompl_cell SCENARIO.txt RUNS SEED METHOD   (METHOD: rrtc or lazyprm; SCENARIO.txt as adapt.py writes it)
// Prints JSON: cumulative evaluations and seconds a task, path lengths, and of how many paths an exact continuous check
// finds a collision.
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/prm/LazyPRM.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <random>
#include <string>
#include <vector>

namespace ob = ompl::base;
namespace og = ompl::geometric;
using P = std::array<double, 2>;
using Polygon = std::vector<P>;
using State = ob::RealVectorStateSpace::StateType;

struct Scenario {
    double link1, link2, radius, low1, high1, low2, high2, step;
    int tasks, change;
    std::vector<Polygon> obstacles;  // the last one comes with the change
    std::vector<P> goals;            // the first is home, the last comes with the change
};

static Scenario scenario;
static size_t obstacles;  // how many are there now
static long evaluations;

static double cross(P a, P b, P c) { return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]); }

static double apart(P p, P a, P b) {
    const double dx = b[0] - a[0], dy = b[1] - a[1];
    const double share = std::clamp(((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
    return std::hypot(p[0] - a[0] - share * dx, p[1] - a[1] - share * dy);
}

static double apart(P a, P b, P c, P d) {
    const bool cuts = (cross(a, b, c) > 0) != (cross(a, b, d) > 0) && (cross(c, d, a) > 0) != (cross(c, d, b) > 0);
    if (cuts) return 0;
    return std::min(std::min(apart(a, c, d), apart(b, c, d)), std::min(apart(c, a, b), apart(d, a, b)));
}

static bool inside(P p, const Polygon& q) {
    bool is_in = false;
    for (size_t i = 0, j = q.size() - 1; i < q.size(); j = i++)
        if ((q[i][1] > p[1]) != (q[j][1] > p[1]) &&
            p[0] < (q[j][0] - q[i][0]) * (p[1] - q[i][1]) / (q[j][1] - q[i][1]) + q[i][0])
            is_in = !is_in;
    return is_in;
}

// Metres between the arm and an obstacle, 0 or less where they touch.
static double clearance(P at, const Polygon& q) {
    const P base{0, 0};
    const P elbow{scenario.link1 * std::cos(at[0]), scenario.link1 * std::sin(at[0])};
    const P tool{elbow[0] + scenario.link2 * std::cos(at[0] + at[1]), elbow[1] + scenario.link2 * std::sin(at[0] + at[1])};
    if (inside(elbow, q) || inside(tool, q)) return -1;
    double least = 1e9;
    for (size_t i = 0; i < q.size(); i++) {
        const P a = q[i], b = q[(i + 1) % q.size()];
        least = std::min({least, apart(base, elbow, a, b), apart(elbow, tool, a, b)});
    }
    return least - scenario.radius;
}

// A configuration costs as many evaluations as there are obstacles, as in the reference's figures.
static bool valid(const ob::State* state) {
    const auto* at = state->as<State>();
    evaluations += obstacles;
    for (size_t i = 0; i < obstacles; i++) {
        if (clearance({at->values[0], at->values[1]}, scenario.obstacles[i]) <= 0) return false;
    }
    return true;
}

// Whether a path touches anything, by conservative advancement to a tenth of a millimetre; not counted.
static bool touches(const std::vector<P>& path) {
    const double reach = scenario.link1 + scenario.link2;
    for (size_t i = 0; i + 1 < path.size(); i++) {
        const double d1 = path[i + 1][0] - path[i][0], d2 = path[i + 1][1] - path[i][1];
        const double travel = std::max(std::abs(d1) * reach + std::abs(d2) * scenario.link2, 1e-9);
        for (double share = 0;;) {
            double least = 1e9;
            for (size_t k = 0; k < obstacles; k++)
                least = std::min(least, clearance({path[i][0] + share * d1, path[i][1] + share * d2}, scenario.obstacles[k]));
            if (least < 0) return true;
            if (share >= 1) break;
            share = std::min(1.0, share + std::max(least, 1e-4) / travel);
        }
    }
    return false;
}

static void read(const char* file) {
    std::ifstream in(file);
    auto& s = scenario;
    size_t count;
    in >> s.link1 >> s.link2 >> s.radius >> s.low1 >> s.high1 >> s.low2 >> s.high2 >> s.step >> s.tasks >> s.change >> count;
    s.obstacles.resize(count);
    for (auto& polygon : s.obstacles) {
        in >> count;
        polygon.resize(count);
        for (auto& p : polygon) in >> p[0] >> p[1];
    }
    in >> count;
    s.goals.resize(count);
    for (auto& p : s.goals) in >> p[0] >> p[1];
    if (!in) {
        std::fprintf(stderr, "%s is no scenario\n", file);
        std::exit(2);
    }
}

int main(int argc, char** argv) {
    if (argc != 5) {
        std::fprintf(stderr, "usage: ompl_cell SCENARIO.txt RUNS SEED rrtc|lazyprm\n");
        return 2;
    }
    ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
    read(argv[1]);
    const int runs = std::atoi(argv[2]);
    const unsigned seed = std::atoi(argv[3]);
    const bool learns = std::string(argv[4]) == "lazyprm";
    ompl::RNG::setSeed(seed + 1);
    const int tasks = scenario.tasks;
    std::vector<double> cost(tasks), seconds(tasks), length(tasks);
    long failures = 0, touching = 0;
    for (int run = 0; run < runs; run++) {
        std::mt19937 chance(seed + run);
        obstacles = scenario.obstacles.size() - 1;
        evaluations = 0;
        auto space = std::make_shared<ob::RealVectorStateSpace>(2);
        ob::RealVectorBounds bounds(2);
        bounds.low = {scenario.low1, scenario.low2};
        bounds.high = {scenario.high1, scenario.high2};
        space->setBounds(bounds);
        const auto setup = [&] {
            auto simple = std::make_shared<og::SimpleSetup>(space);
            simple->setStateValidityChecker(valid);
            const auto& information = simple->getSpaceInformation();
            information->setStateValidityCheckingResolution(scenario.step / space->getMaximumExtent());
            if (learns) simple->setPlanner(std::make_shared<og::LazyPRM>(information));
            else simple->setPlanner(std::make_shared<og::RRTConnect>(information));
            return simple;
        };
        auto kept = setup();
        size_t here = 0;
        double spent = 0;
        for (int task = 0; task < tasks; task++) {
            if (task == scenario.change) {
                obstacles = scenario.obstacles.size();
                if (learns) kept->getPlanner()->as<og::LazyPRM>()->clearValidity();
            }
            const size_t known = scenario.goals.size() - (task >= scenario.change ? 1 : 2);
            size_t goal;
            do goal = 1 + chance() % known;
            while (goal == here);
            const auto began = std::chrono::steady_clock::now();
            if (!learns) kept = setup();
            ob::ScopedState<> from(space), to(space);
            for (int k = 0; k < 2; k++) {
                from[k] = scenario.goals[here][k];
                to[k] = scenario.goals[goal][k];
            }
            if (learns) {
                kept->getProblemDefinition()->clearSolutionPaths();
                kept->getPlanner()->as<og::LazyPRM>()->clearQuery();
                kept->clearStartStates();
            }
            kept->setStartAndGoalStates(from, to, 1e-9);
            const bool found = kept->solve(5.0) == ob::PlannerStatus::EXACT_SOLUTION;
            spent += std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
            if (found) {
                std::vector<P> path;
                for (auto* state : kept->getSolutionPath().getStates())
                    path.push_back({state->as<State>()->values[0], state->as<State>()->values[1]});
                length[task] += kept->getSolutionPath().length();
                touching += touches(path);
            } else {
                failures++;
            }
            here = goal;
            cost[task] += evaluations;
            seconds[task] += spent;
        }
    }
    const auto list = [&](const char* name, const std::vector<double>& values, const char* end) {
        std::printf("\"%s\": [", name);
        for (size_t i = 0; i < values.size(); i++) std::printf("%s%.9g", i ? ", " : "", values[i] / runs);
        std::printf("]%s", end);
    };
    std::printf("{\"method\": \"%s\", \"runs\": %d, \"failures\": %ld, \"touching\": %ld, ", argv[4], runs, failures, touching);
    list("evaluations", cost, ", ");
    list("seconds", seconds, ", ");
    list("path_length", length, "}\n");
}
