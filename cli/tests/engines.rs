//! Campaigns on engines that are there already: the files of `tests/campaigns` say what the engines
//! document, and each of their commands is one that the program takes.

use crate::common::{Ended, Folder};
use serde_json::{Map, Value};
use std::fs;
use std::path::{Path, PathBuf};

fn workspace() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn text(name: &str) -> String {
    fs::read_to_string(workspace().join("tests/campaigns").join(name)).unwrap()
}

/// A line of YAML: its indentation and what stands there.
type Row<'t> = (usize, &'t str);

/// Reads the YAML of these files: mappings, lists, texts after `|`, lists in brackets, no more.
fn yaml(text: &str) -> Value {
    let rows: Vec<Row<'_>> = text
        .lines()
        .filter(|it| !it.trim_start().starts_with('#') && !it.trim().is_empty())
        .map(|it| (it.len() - it.trim_start().len(), it.trim_start()))
        .collect();
    let (value, rest) = node(&rows, 0);
    assert!(rest.is_empty(), "{rest:?}");
    value
}

/// Reads the node that begins with the first row, which is indented so far; returns the rows that
/// are left.
fn node<'r, 't>(rows: &'r [Row<'t>], indent: usize) -> (Value, &'r [Row<'t>]) {
    if rows[0].1.starts_with("- ") { list(rows, indent) } else { mapping(rows, indent) }
}

fn list<'r, 't>(mut rows: &'r [Row<'t>], indent: usize) -> (Value, &'r [Row<'t>]) {
    let mut all = Vec::new();
    while let Some((_, item)) = rows.first().filter(|it| it.0 == indent && it.1.starts_with("- ")) {
        let item = &item[2..];
        let below = 1 + rows[1..].iter().take_while(|it| it.0 > indent).count();
        if item == "|" {
            all.push(block(&rows[1..below]));
        } else if item.contains(": ") || item.ends_with(':') {
            // The first key stands where the others do.
            let mut of: Vec<Row<'_>> = vec![(indent + 2, item)];
            of.extend_from_slice(&rows[1..below]);
            let (value, rest) = mapping(&of, indent + 2);
            assert!(rest.is_empty(), "{rest:?}");
            all.push(value);
        } else {
            all.push(scalar(item));
        }
        rows = &rows[below..];
    }
    (Value::Array(all), rows)
}

fn mapping<'r, 't>(mut rows: &'r [Row<'t>], indent: usize) -> (Value, &'r [Row<'t>]) {
    let mut all = Map::new();
    while let Some((_, line)) = rows.first().filter(|it| it.0 == indent && !it.1.starts_with("- "))
    {
        let (key, value) = line.split_once(':').unwrap_or_else(|| panic!("no key: {line}"));
        let value = value.trim();
        let deeper = |it: &&Row<'_>| it.0 > indent || (it.0 == indent && it.1.starts_with("- "));
        let below = 1 + rows[1..].iter().take_while(deeper).count();
        let value = match value {
            "|" => block(&rows[1..below]),
            "" if below == 1 => Value::Null,
            "" => {
                let (value, rest) = node(&rows[1..below], rows[1].0);
                assert!(rest.is_empty(), "{rest:?}");
                value
            }
            value => scalar(value),
        };
        assert!(all.insert(key.to_owned(), value).is_none(), "{key} stands there twice");
        rows = &rows[below..];
    }
    (Value::Object(all), rows)
}

fn block(rows: &[Row<'_>]) -> Value {
    let least = rows.iter().map(|it| it.0).min().unwrap_or(0);
    let lines = rows.iter().map(|it| " ".repeat(it.0 - least) + it.1 + "\n");
    Value::String(lines.collect())
}

fn scalar(text: &str) -> Value {
    if let Some(all) = text.strip_prefix('[').and_then(|it| it.strip_suffix(']')) {
        return all.split(',').map(|it| scalar(it.trim())).collect();
    }
    if let Some(text) = text.strip_prefix('"').and_then(|it| it.strip_suffix('"')) {
        return text.into();
    }
    match text {
        "true" => true.into(),
        "false" => false.into(),
        _ => text.parse::<u64>().map_or_else(|_| text.into(), Into::into),
    }
}

/// The lines of a Containerfile: instruction and arguments, by the number of the stage.
fn stages(text: &str) -> Vec<Vec<(String, Vec<String>)>> {
    let mut stages: Vec<Vec<_>> = Vec::new();
    for line in text.lines().filter(|it| !it.starts_with('#') && !it.trim().is_empty()) {
        let (instruction, rest) = line.split_once(' ').unwrap();
        if instruction == "FROM" {
            stages.push(Vec::new());
        }
        let words = rest.split_whitespace().map(str::to_owned).collect();
        stages.last_mut().unwrap().push((instruction.to_owned(), words));
    }
    stages
}

#[test]
fn the_image_is_built_of_what_the_workspace_has_and_holds_the_program() {
    let root = workspace();
    let stages = stages(&text("Containerfile"));
    assert_eq!(stages.len(), 2);
    let all = |instruction: &str, stage: usize| {
        let found = stages[stage].iter().filter(|it| it.0 == instruction);
        found.map(|it| it.1.clone()).collect::<Vec<_>>()
    };
    // The compiler is the one that the workspace asks for, on the Debian of the second stage.
    let manifest: toml::Table =
        fs::read_to_string(root.join("Cargo.toml")).unwrap().parse().unwrap();
    let workspace = &manifest["workspace"];
    let least = workspace["package"]["rust-version"].as_str().unwrap();
    let from = &all("FROM", 0)[0];
    assert_eq!(from[0], format!("docker.io/library/rust:{least}-slim-bookworm"));
    assert_eq!((from[1].as_str(), from[2].as_str()), ("AS", "build"));
    assert_eq!(all("FROM", 1)[0], ["docker.io/library/debian:bookworm-slim"]);
    // Copied files exist, and hold every member of the workspace.
    let mut copied = Vec::new();
    for words in all("COPY", 0) {
        let (to, from) = words.split_last().unwrap();
        for it in from {
            assert!(root.join(it).exists(), "{it} is not there");
            assert!(to == "./" || to == it, "{it} is copied to {to}");
            copied.push(it.clone());
        }
    }
    for member in workspace["members"].as_array().unwrap() {
        let member = member.as_str().unwrap().trim_end_matches('*');
        let is_there = copied.iter().any(|it| Path::new(member).starts_with(it));
        assert!(is_there, "{member} is not copied");
    }
    assert!(copied.contains(&"Cargo.lock".to_owned()));
    // The image builds the program by an existing profile, and takes it from its folder.
    let build = all("RUN", 0)[0].join(" ");
    assert_eq!(build, "cargo build --locked --profile dist -p cotama");
    assert!(manifest["profile"].as_table().unwrap().contains_key("dist"));
    assert_eq!(all("WORKDIR", 0)[0], ["/src"]);
    let program = &all("COPY", 1)[0];
    assert_eq!(program.join(" "), "--from=build /src/target/dist/cotama /usr/local/bin/cotama");
    assert_eq!(all("ENTRYPOINT", 1)[0], ["[\"cotama\"]"]);
    let folder = Folder::new("image");
    for words in all("CMD", 1) {
        let words: Vec<String> = serde_json::from_str(&words.join(" ")).unwrap();
        let words: Vec<_> = words.iter().map(String::as_str).collect();
        assert_eq!(folder.cotama(&words).code, Some(0), "{words:?}");
    }
}

/// A job's shards and their merge, in place of `/results` in a folder: the command of a pod with
/// the variables that the pod and its index give.
fn pod(folder: &Folder, job: &Value, index: usize, more: &str) -> Ended {
    let container = &job["spec"]["template"]["spec"]["containers"][0];
    let mut line = format!("export JOB_COMPLETION_INDEX={index}\n");
    for it in container["env"].as_array().unwrap() {
        let name = it["name"].as_str().unwrap();
        line += &["export ", name, "=", it["value"].as_str().unwrap(), "\n"].concat();
    }
    assert_eq!(container["command"], serde_json::json!(["/bin/sh", "-c"]));
    let args = container["args"][0].as_str().unwrap().replace("/results/", "results/");
    folder.shell(&format!("{line}{more}\n{args}"))
}

#[test]
fn a_kubernetes_job_never_runs_a_shard_twice_at_once_and_its_pods_run() {
    let job = yaml(&text("kubernetes.yaml"));
    assert_eq!((&job["apiVersion"], &job["kind"]), (&"batch/v1".into(), &"Job".into()));
    let (spec, pod_spec) = (&job["spec"], &job["spec"]["template"]["spec"]);
    // The API asks for these together: a limit per index needs indices and pods that do not
    // restart, a policy of failures needs pods that are replaced when they have failed.
    assert_eq!(spec["completionMode"], "Indexed");
    assert!(spec["backoffLimitPerIndex"].as_u64().unwrap() > 0);
    assert_eq!(spec["podReplacementPolicy"], "Failed");
    assert_eq!(pod_spec["restartPolicy"], "Never");
    let rules = spec["podFailurePolicy"]["rules"].as_array().unwrap();
    let container = &pod_spec["containers"][0];
    for rule in rules {
        let action = rule["action"].as_str().unwrap();
        assert!(["Ignore", "Count", "FailIndex", "FailJob"].contains(&action), "{action}");
        let (codes, conditions) = (&rule["onExitCodes"], &rule["onPodConditions"]);
        assert!(codes.is_null() != conditions.is_null(), "one of both: {rule}");
        if !codes.is_null() {
            assert_eq!(codes["containerName"], container["name"]);
            assert_eq!(codes["operator"], "In");
        }
        for it in conditions.as_array().into_iter().flatten() {
            assert_eq!((&it["type"], &it["status"]), (&"DisruptionTarget".into(), &"True".into()));
        }
    }
    let bad_input = rules.iter().find(|it| it["action"] == "FailJob").unwrap();
    assert_eq!(bad_input["onExitCodes"]["values"], serde_json::json!([2]));
    for kind in ["requests", "limits"] {
        for what in ["cpu", "memory"] {
            assert!(container["resources"][kind][what].is_string(), "{kind} {what}");
        }
    }
    let mounted = container["volumeMounts"][0]["name"].as_str().unwrap();
    assert_eq!(pod_spec["volumes"][0]["name"], mounted);
    // The image is the one that the Containerfile says how to build.
    let image = container["image"].as_str().unwrap();
    assert!(text("Containerfile").contains(&format!("-t {image} .")));
    let shards = spec["completions"].as_u64().unwrap();
    let env = container["env"].as_array().unwrap();
    let said = env.iter().find(|it| it["name"] == "SHARDS").unwrap();
    assert_eq!(said["value"], shards.to_string());

    let folder = Folder::new("kubernetes");
    fs::create_dir(folder.path().join("results")).unwrap();
    for index in 0..2 {
        let ended = pod(&folder, &job, index, "MISSION=patrol RUNS=1500 SHARDS=2");
        assert_eq!(ended.code, Some(0), "{ended:?}");
    }
    let merged = folder.shell("cotama campaign merge results/[0-9]* --out whole --shrink 0");
    assert_eq!(merged.code, Some(1), "{merged:?}");
    assert_eq!(folder.read("whole/runs.jsonl").lines().count(), 1_500);
    // The exit code that the policy is about is that of the pod.
    let bad = pod(&folder, &job, 0, "MISSION=nowhere RUNS=10 SHARDS=2");
    assert_eq!(bad.code, Some(2), "{bad:?}");
}

#[test]
fn a_job_array_of_slurm_runs_shards_that_merge() {
    let (script, folder) = (text("slurm.sh"), Folder::new("slurm"));
    assert!(script.lines().any(|it| it.starts_with("#SBATCH --array=1-")));
    for task in 1..=2 {
        let ended = folder.shell(&format!(
            "export SLURM_ARRAY_TASK_ID={task} SLURM_ARRAY_TASK_COUNT=2 MISSION=patrol RUNS=1200\n\
             {script}"
        ));
        assert_eq!(ended.code, Some(0), "{ended:?}");
    }
    let ended = folder.shell("cotama campaign merge results/[0-9]* --out whole --shrink 0");
    assert_eq!(ended.code, Some(1), "{ended:?}");
    let line = format!("export SLURM_ARRAY_TASK_ID=1 MISSION=nowhere\n{script}");
    assert_eq!(folder.shell(&line).code, Some(2));
}

#[test]
fn every_step_of_the_workflow_runs_and_what_one_job_takes_another_leaves() {
    let workflow = yaml(&text("github-actions.yaml"));
    let jobs = workflow["jobs"].as_object().unwrap();
    let shard = &jobs["shard"];
    let indices = shard["strategy"]["matrix"]["index"].as_array().unwrap();
    let numbers: Vec<_> = indices.iter().map(|it| it.as_u64().unwrap()).collect();
    assert_eq!(numbers, (1..=numbers.len() as u64).collect::<Vec<_>>());
    // Jobs need jobs that there are; each artifact that is taken was left before.
    let mut left = Vec::new();
    assert_eq!(jobs.len(), 3);
    for name in ["program", "shard", "merge"] {
        let job = &jobs[name];
        if let Some(needs) = job["needs"].as_str() {
            assert!(jobs.contains_key(needs), "{name} needs {needs}");
        }
        for step in job["steps"].as_array().unwrap() {
            let artifact = step["with"]["name"].as_str().or(step["with"]["pattern"].as_str());
            match (step["uses"].as_str().unwrap_or(""), artifact) {
                (uses, Some(artifact)) if uses.starts_with("actions/upload-artifact@v") => {
                    left.push(artifact.to_owned());
                }
                (uses, Some(artifact)) if uses.starts_with("actions/download-artifact@v") => {
                    let stem = artifact.trim_end_matches('*');
                    assert!(left.iter().any(|it| it.starts_with(stem)), "{artifact} of {left:?}");
                }
                (uses, _) => assert!(uses.is_empty() || uses.starts_with("actions/checkout@v")),
            }
        }
    }
    // Each `run:`, in a folder for each job, as the runner runs it.
    let folder = Folder::new("actions");
    let program = env!("CARGO_BIN_EXE_cotama");
    folder.shell(&format!("mkdir bin && cp {program} bin/cotama && chmod -x bin/cotama"));
    let run = |job: &str, index: u64, env: &str| {
        let steps = jobs[job]["steps"].as_array().unwrap();
        let line = steps.iter().find_map(|it| it["run"].as_str()).unwrap();
        let line = line.replace("${{ matrix.index }}", &index.to_string());
        let line = line.replace("${{ strategy.job-total }}", "2");
        assert!(!line.contains("${{"), "{line}");
        folder.write("step.sh", line);
        folder.shell(&format!("export {env}; bash --noprofile --norc -eo pipefail step.sh"))
    };
    let build = jobs["program"]["steps"].as_array().unwrap();
    let build = build.iter().find_map(|it| it["run"].as_str()).unwrap();
    let image = stages(&text("Containerfile"));
    let as_image = image[0].iter().find(|it| it.0 == "RUN").unwrap().1.join(" ");
    assert_eq!(build, as_image, "the program is built as that of the image");
    let env = "MISSION=patrol RUNS=1300";
    for index in 1..=2 {
        let ended = run("shard", index, env);
        assert_eq!(ended.code, Some(0), "{ended:?}");
    }
    folder.shell("mkdir parts && mv part-* parts");
    let merged = run("merge", 0, env);
    assert_eq!(merged.code, Some(1), "red, as the requirement is broken: {merged:?}");
    assert_eq!(folder.read("whole/runs.jsonl").lines().count(), 1_300);
    let junit = folder.read("junit.xml");
    assert!(junit.contains("<testcase classname=\"patrol\" name=\"not-failed\">"), "{junit}");
    let bad = run("shard", 1, "MISSION=nowhere RUNS=1");
    assert_eq!(bad.code, Some(1), "bad input is no success: {bad:?}");
}

#[test]
fn yaml_is_read_as_it_says() {
    let text = "# a comment\na: 1\nb:\n  - x: \"1\"\n    y: [p, 2]\n  - true\nc:\n- |\n  one\n    \
                two\nd: e: f\n";
    let read = serde_json::json!({
        "a": 1, "b": [{ "x": "1", "y": ["p", 2] }, true], "c": ["one\n  two\n"], "d": "e: f"
    });
    assert_eq!(yaml(text), read);
}
