#!/usr/bin/env python3
"""Records the delivery in the plane, and lets other programs read its files: `mcap` with
`mcap-ros2-support` and `rosbags` the MCAP file, evo the poses. All that they read is held against
the trace of the same run.

    read_recording.py [--cotama PROGRAM] [--mission MISSION]

Exit status 1 when something differs, 77 when a package is missing and nothing is shown.
"""

import argparse
import collections
import json
import math
import pathlib
import subprocess
import sys
import tempfile

try:
    from mcap.reader import make_reader
    from mcap_ros2.decoder import DecoderFactory
    from rosbags.highlevel import AnyReader
    from rosbags.typesys import Stores, get_types_from_msg, get_typestore
except ImportError as missing:
    print(f"SKIPPED, NOTHING IS SHOWN: {missing}; pip install -r requirements.txt", file=sys.stderr)
    sys.exit(77)

FLOATS = {"/speed_m_s": ["speed_mm_s"], "/power_w": ["real_power_mw"],
    "/margins/duration_s": ["margins", "duration_ms"], "/margins/energy_j": ["margins", "energy_mj"]}
AT_POSES = ["/tf", "/pose", "/odom", "/scan", "/sonars"] + [f"/sonar_{it}" for it in range(16)]

wrong = []


def hold(what, found, expected):
    if found != expected:
        wrong.append(what)
        print(f"DIFFERENT: {what}: {found}, expected {expected}")


def near(what, found, expected, most=1e-6):
    if not all(abs(a - b) <= most for a, b in zip(found, expected, strict=True)):
        wrong.append(what)
        print(f"DIFFERENT: {what}: {found}, expected {expected}")


def turn(of):
    return 2 * math.atan2(of.z, of.w)


def times_of(trace):
    """Times in ns at which the trace has something for each topic."""
    times = collections.defaultdict(list)
    for record in trace["records"]:
        at, kind = record["t_us"] * 1000, record["record"]
        if kind == "sample":
            for topic in ["/battery", *FLOATS]:
                times[topic].append(at)
        elif kind == "fired":
            times["/supervisors/" + record["net"]].append(at)
        elif kind in ("failure", "diagnosis"):
            times["/diagnostics"].append(at)
        elif kind in ("configuration", "status"):
            times["/" + kind].append(at)
    for topic in AT_POSES:
        times[topic] = [it["t_us"] * 1000 for it in trace["poses"]]
    for topic in ["/map", "/path", "/tf_static"]:
        times[topic] = [0]
    return times


def read_trace(path):
    header, *records = [json.loads(line) for line in path.read_text("utf-8").splitlines()]
    poses = {it["t_us"]: it for it in records if it["record"] == "pose"}
    return {"header": header, "records": records, "poses": list(poses.values())}


def hold_values(trace, read):
    """Compares values of messages by topic with those of the trace."""
    for pose, message in zip(trace["poses"], read["/tf"]):
        origin, robot = [it.transform for it in message.transforms]
        a, (x, y) = turn(origin.rotation), (robot.translation.x, robot.translation.y)
        at = (origin.translation.x + math.cos(a) * x - math.sin(a) * y,
            origin.translation.y + math.sin(a) * x + math.cos(a) * y)
        near("map to base_link", at, [it / 1000 for it in pose["at_mm"]])
        off = a + turn(robot.rotation) - pose["heading_mrad"] / 1000
        near("heading", [math.remainder(off, math.tau)], [0])
    for topic, place, heading in [("/pose", "at_mm", "heading_mrad"),
            ("/odom", "odometry_mm", "odometry_mrad")]:
        for pose, message in zip(trace["poses"], read[topic]):
            at = message.pose.pose
            near(topic, (at.position.x, at.position.y), [it / 1000 for it in pose[place]])
            off = turn(at.orientation) - pose[heading] / 1000
            near(topic + " heading", [math.remainder(off, math.tau)], [0])
    samples = [it for it in trace["records"] if it["record"] == "sample"]
    limit = trace["header"]["limits"]["energy_mj"]
    for sample, message in zip(samples, read["/battery"]):
        left = 1 - sample["used"]["energy_mj"] / limit
        near("/battery", [message.percentage], [min(max(left, 0), 1)])
        known = {it["t_us"]: it.get("battery_mv_ma") for it in trace["poses"]}.get(sample["t_us"])
        if known:
            near("/battery", [message.voltage, -message.current], [it / 1000 for it in known], 1e-4)
    for topic, keys in FLOATS.items():
        for sample, message in zip(samples, read[topic]):
            value = sample
            for key in keys:
                value = value[key]
            near(topic, [message.data], [value / 1000], 1e-9)
    fired = collections.defaultdict(list)
    for it in trace["records"]:
        if it["record"] == "fired":
            fired["/supervisors/" + it["net"]].append(it["place"])
    for topic, places in fired.items():
        hold(topic, [it.data for it in read[topic]], places)
    told = [it.get("mode", "diagnosis") for it in trace["records"]
        if it["record"] in ("failure", "diagnosis")]
    hold("/diagnostics", [it.status[0].name for it in read["/diagnostics"]], told)
    for message in read["/scan"]:
        hold("rays", len(message.ranges), 180)
        last = message.angle_min + 179 * message.angle_increment
        near("angles", [last], [message.angle_max], 1e-4)
    grid, = read["/map"]
    hold("cells", len(grid.data), grid.info.width * grid.info.height)
    cells = set(grid.data)
    hold("kinds of cells", cells, {0, 100})
    for pose in trace["poses"]:
        x, y = [int(it / 1000 / grid.info.resolution) for it in pose["at_mm"]]
        hold("cell of the robot", grid.data[y * grid.info.width + x], 0)


def by_mcap(path):
    read, times, types = collections.defaultdict(list), collections.defaultdict(list), {}
    with path.open("rb") as file:
        reader = make_reader(file, decoder_factories=[DecoderFactory()])
        for schema, channel, message, decoded in reader.iter_decoded_messages():
            read[channel.topic].append(decoded)
            times[channel.topic].append(message.log_time)
            types[channel.topic] = schema.name
        counted = reader.get_summary().statistics.message_count
    hold("messages that the file says it has", counted, sum(map(len, read.values())))
    return read, times, types


def by_rosbags(path):
    read, times, types = collections.defaultdict(list), collections.defaultdict(list), {}
    humble = get_typestore(Stores.ROS2_HUMBLE)
    with AnyReader([path]) as reader:
        for connection in reader.connections:
            types[connection.topic] = connection.msgtype
            defined = get_types_from_msg(connection.msgdef.data, connection.msgtype)
            for name, (_constants, fields) in defined.items():
                hold(f"fields of {name}", fields, humble.fielddefs[name][1])
        last = -1
        for connection, time, raw in reader.messages():
            hold("order of time", time >= last, True)
            last = time
            read[connection.topic].append(reader.deserialize(raw, connection.msgtype))
            times[connection.topic].append(time)
    return read, times, types


def by_evo(folder, poses):
    try:
        from evo.core import metrics, sync
        from evo.tools import file_interface
    except ImportError as missing:
        print(f"SKIPPED: poses are not read by evo: {missing}", file=sys.stderr)
        return
    truth, told = [file_interface.read_tum_trajectory_file(str(folder / f"run.{it}.tum"))
        for it in ("truth", "odometry")]
    hold("poses that evo reads", [truth.num_poses, told.num_poses], [poses, poses])
    hold("evo's check", [truth.check()[0], told.check()[0]], [True, True])
    error = metrics.APE(metrics.PoseRelation.translation_part)
    error.process_data(sync.associate_trajectories(truth, told))
    print(f"evo: {poses} poses, {truth.path_length:.3f} m, APE of odometry:",
        f"{error.get_statistic(metrics.StatisticsType.rmse):.4f} m (rmse)")


def main():
    asked = argparse.ArgumentParser()
    asked.add_argument("--cotama")
    asked.add_argument("--mission", default="delivery")
    asked = asked.parse_args()
    built = ["cargo", "run", "--quiet", "--release", "-p", "cotama", "--"]
    program = [asked.cotama] if asked.cotama else built
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        wanted = ["--no-report", "--trace", folder / "run.jsonl", "--mcap", folder / "run.mcap",
            "--tum", folder / "run"]
        subprocess.run([*program, "run", asked.mission, "--fidelity", "plane", *wanted],
            check=True, stdout=subprocess.DEVNULL)
        trace = read_trace(folder / "run.jsonl")
        expected = times_of(trace)
        size = (folder / "run.mcap").stat().st_size
        seconds = trace["records"][-1]["t_us"] / 1e6
        print(f"{asked.mission}: {seconds:.1f} s, {size} bytes, {len(trace['poses'])} poses")
        kinds = []
        for reader in (by_mcap, by_rosbags):
            read, times, types = reader(folder / "run.mcap")
            log = times.pop("/log")
            hold("order of the log", log, sorted(log))
            hold("topics", sorted(times), sorted(expected))
            for topic, at in expected.items():
                hold(f"times of {topic}", times[topic], at)
            hold_values(trace, read)
            kinds.append(types)
            print(f"{reader.__name__[3:]}: {sum(map(len, read.values()))} messages,",
                f"{len(types)} topics, {len(set(types.values()))} types")
        hold("types", *kinds)
        by_evo(folder, len(trace["poses"]))
    print(f"{len(wrong)} wrong")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
