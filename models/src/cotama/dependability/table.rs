//! The rows of the FMECA, one copy: numbers and sets go to [`RULES`], words to [`TEXTS`].
//!
//! Source: rows that name TAROS 2010 follow Durand et al., TAROS 2010, Sections IV to VI, where
//! they name a fault; the others fill the same form for a Pioneer 3-DX and are assumed, with shares
//! and common causes after Carlson and Murphy, IEEE Trans. Robotics 21, 2005, where a row says so.

use super::adjustment::Adjustment;
use super::flags::{Flag, Flags};
use super::rule::{Description, Rule, Signature};
use crate::cotama::decisions::{Class, Report, Severity};
use crate::cotama::label::Label;
use crate::cotama::members::members;
use crate::cotama::modules::{Module, Modules, Resource, Resources};
use crate::severity::Persistence;

rows! {
    Son1 "SON1" "perceive obstacles" "sonar array" "one transducer stuck at maximum range" {
        cause "broken transducer or cable",
        effect "obstacle not seen in one sector; MCL weights biased";
        severity Medium Medium, class Adapter, Permanent;
        lost "UST MCL SMZ DVZ SIM" [] [SonarArrays];
        seen "O-SEN"
             "range = 5 m for more than T_stuck while the robot moves more than d_min \
              (TAROS 2010, VI.A.3)"
             5_000 (flags [SonarFar] with Ust);
        answer Sonar "degraded path following without avoidance and MCL, lower speed; \
                      teleoperation without avoidance";
        rate 400_000 Assumed "assumed", injection "sonar[i]=5.0 from t on";
    }
    Son2 "SON2" "perceive obstacles" "sonar array" "whole array silent" {
        cause "array power or serial board lost", effect "no range data";
        severity Medium Medium, class Adapter, Permanent;
        lost "UST MCL SMZ DVZ SIM" [] [SonarArrays];
        seen "O-SEN" "no fresh range for 3 firing cycles (timing check)"
             1_000 (flags [SonarSilent] sometimes [SonarFar] with Ust);
        answer Sonar "as SON1";
        rate 800_000 Assumed "assumed", injection "all sonars 5.0 or no update";
    }
    Son3 "SON3" "perceive obstacles" "sonar array" "stuck at a short range" {
        cause "dirt, damaged foil, cross-talk",
        effect "phantom obstacle; robot stops or turns back";
        severity Medium Weak, class Adapter, Permanent;
        lost "UST MCL SMZ DVZ SIM" [] [SonarArrays];
        seen "O-SEN; O-PF"
             "range constant within 1 cm while robot moves more than 1 m; backward motion too long"
             4_000 (flags [SonarNear] sometimes [Backward] with Ust);
        answer Sonar "as SON1";
        rate 600_000 Assumed "assumed", injection "sonar[i]=0.3 from t on";
    }
    Son4 "SON4" "perceive obstacles" "sonar array" "outliers, cross-talk, specular echoes" {
        cause "acoustics, other robot, smooth walls", effect "noisy map matching";
        severity Weak Weak, class Adapter, Transient;
        lost "-" [] [];
        seen "O-SEN" "share of rejected readings above threshold over 2 s"
             2_000 (flags [SonarOutliers] with Ust);
        answer Minor "reject more readings, fewer weights in MCL", adjusts RejectReadings;
        rate 10_000 Assumed "assumed", injection "with p replace a reading by U(0.1,5)";
    }
    Odo1 "ODO1" "estimate motion" "encoder (left or right)" "no ticks" {
        cause "cable, encoder disc, connector", effect "odometry turns falsely; heading lost";
        severity Hard Medium, class Local, Permanent;
        lost "NAV ODO" [Nav, Odo] [Encoders];
        seen "O-EFF; O-LOC" "multiple-model Kalman filter residual; odometry-MCL distance"
             1_500 (flags [WheelResidual, PoseDistance] with Odo);
        answer Vital "stop, ask the operator; degraded teleoperation";
        rate 700_000 Assumed "assumed", injection "ticks_l=0";
    }
    Odo2 "ODO2" "estimate motion" "encoder" "ticks lost in part" {
        cause "loose disc, electrical noise", effect "drift";
        severity Medium Weak, class Adapter, Intermittent;
        lost "ODO" [Odo] [];
        seen "O-LOC; O-EFF" "odometry-MCL distance growth above rate limit"
             6_000 (flags [PoseGrowth] sometimes [WheelResidual, Backward] with Odo);
        answer Minor "use MCL pose, inflate odometry noise", adjusts TrustLocalisation;
        rate 300_000 Assumed "assumed", injection "ticks*=1-u, u in 0.05..0.3";
    }
    Odo3 "ODO3" "estimate motion" "wheels" "slip on a threshold, cable or wet floor" {
        cause "floor", effect "jump of the odometric pose";
        severity Weak Weak, class Adapter, Transient;
        lost "-" [] [];
        seen "O-LOC; O-EFF" "residual peak then back to normal"
             2_000 (flags [PosePeak] sometimes [WheelPeak]);
        answer Minor "inflate odometry noise for some seconds", adjusts WidenNoise;
        rate 3_000 Assumed "assumed", injection "add pose jump 0.05-0.3 m or 5-20 deg";
    }
    Odo4 "ODO4" "estimate motion" "wheels" "unequal diameters (tyre pressure, load)" {
        cause "wear, load", effect "systematic heading drift";
        severity Weak Weak, class Adapter, Permanent;
        lost "-" [] [];
        seen "O-LOC" "slow odometry-MCL drift of constant sign" 30_000 (flags [SlowDrift]);
        answer Minor "recalibrate drift factor on line", adjusts Recalibrate;
        rate 150_000 Assumed "assumed", injection "diameter ratio 1.01";
    }
    Bmp1 "BMP1" "detect contact" "bumper ring" "contact missed" {
        cause "broken switch", effect "collision not reported; stall instead";
        severity Hard Hard, class Local, Permanent;
        lost "P3D(bumper)" [] [Bumpers];
        seen "P3D (motor stall)" "stall without bumper" 1_500 (flags [Stall]);
        answer Ambiguous "stop, ask the operator";
        rate 2_000_000 Assumed "assumed", injection "bumper forced 0";
    }
    Bmp2 "BMP2" "detect contact" "bumper ring" "stuck closed" {
        cause "bent plate, dirt", effect "robot refuses to move";
        severity Hard Hard, class Local, Permanent;
        lost "P3D(bumper)" [] [Bumpers];
        seen "P3D; O-SEN" "bumper closed while sonars see free space"
             1_000 (flags [Bumper, FreeAhead]);
        answer Ambiguous "stop, ask the operator; mask the switch on his order";
        rate 1_500_000 Assumed "assumed", injection "bumper forced 1";
    }
    Cam1 "CAM1" "let the operator see" "camera" "no image" {
        cause "USB, power, driver", effect "operator blind";
        severity Weak Hard, class Adapter, Permanent;
        lost "CAM" [Cam] [Camera];
        seen "O-SEN" "no frame for 1 s" 1_000 (flags [NoFrame] sometimes [OldFrame] with Cam);
        answer Camera "record; in teleoperation back to the hand-over";
        rate 500_000 Assumed "assumed", injection "camera=off";
    }
    Cam2 "CAM2" "let the operator see" "camera or WiFi" "frozen or late image" {
        cause "bandwidth, driver", effect "operator acts on old images";
        severity Weak Medium, class Adapter, Transient;
        lost "-" [] [];
        seen "O-COM; O-SEN" "frame age above 0.5 s"
             500 (flags [OldFrame] sometimes [LinkPoor] with Cam);
        answer Minor "lower frame rate and speed limit", adjusts FewerFrames;
        rate 20_000 Assumed "assumed; limited bandwidth for video is a listed common cause in \
                             Carlson & Murphy 2005",
        injection "frame age += 0.5..3 s";
    }
    Mot1 "MOT1" "move" "drive motor or gearbox" "no torque on one side" {
        cause "brush, gear, H-bridge", effect "robot turns on the spot";
        severity Fatal Fatal, class Global, Permanent;
        lost "P3D(motor) NAV" [Nav] [Motors];
        seen "O-EFF; P3D stall" "Kalman multiple-model: wheel speed does not follow command"
             1_000 (flags [WheelDisobeys, Stall]);
        answer Vital "security objective: stop and alarm";
        rate 250_000 Assumed "assumed (share of the 6-20 h field MTBF of Carlson & Murphy 2005); \
                              effectors 20 % assumed",
        injection "v_wheel=0";
    }
    Mot2 "MOT2" "move" "drive motor" "reduced torque" {
        cause "worn brushes, hot driver, low battery", effect "slow, lags the path";
        severity Medium Weak, class Adapter, Permanent;
        lost "-" [] [];
        seen "O-EFF" "gain of the estimated actuator below 0.8" 3_000 (flags [WheelGain]);
        answer Minor "lower the speed and acceleration limits", adjusts LowerLimits;
        rate 300_000 Assumed "assumed", injection "wheel gain 0.6";
    }
    Mot3 "MOT3" "move" "drive motor" "stall" {
        cause "obstacle, carpet edge, brake by payload", effect "robot stands, motors heat";
        severity Hard Medium, class Local, Transient;
        lost "-" [] [];
        seen "P3D" "stall flag of the micro-controller" 500 (flags [Stall]);
        answer Ambiguous "stop, ask the operator";
        rate 15_000 Assumed "assumed", injection "stall flag set when blocked";
    }
    Mot4 "MOT4" "move" "motor driver" "runaway or wrong sign" {
        cause "H-bridge short, firmware", effect "uncontrolled motion";
        severity Fatal Fatal, class Global, Permanent;
        lost "P3D" [P3d] [Motors];
        seen "O-EFF; P3D" "speed above limit or opposite to command" 300 (flags [Runaway]);
        answer Vital "security objective: cut motor power";
        rate 5_000_000 Assumed "assumed", injection "v_wheel=+v_max";
    }
    Whl1 "WHL1" "move" "caster or wheel" "blocked or lost" {
        cause "hair, screw", effect "arc motion";
        severity Hard Hard, class Local, Permanent;
        lost "-" [] [];
        seen "O-EFF; O-PF" "path error does not converge"
             3_000 (flags [WheelResidual, NoConvergence]);
        answer Ambiguous "stop, ask the operator";
        rate 700_000 Assumed "assumed", injection "yaw disturbance 0.3 rad/s";
    }
    Est1 "EST1" "stop in emergency" "emergency button" "pressed or broken" {
        cause "person, wiring", effect "motors off";
        severity Fatal Fatal, class Global, Permanent;
        lost "P3D(motor)" [] [Motors];
        seen "P3D" "e-stop flag" 100 (flags [EmergencyStop]);
        answer Vital "security objective";
        rate 100_000 Assumed "assumed", injection "motors disabled";
    }
    Bat1 "BAT1" "supply energy" "battery" "low voltage" {
        cause "discharge", effect "end of autonomy close";
        severity Hard Hard, class Local, Permanent;
        lost "-" [] [];
        seen "P3D" "voltage below 11.5 V for 10 s" 10_000 (flags [BatteryLow]);
        answer Ambiguous "ask the operator; go to the charger";
        rate 8_000 Stated "datasheet: 8-10 h run with three batteries",
        injection "voltage model; capacity fault 0.3..1";
    }
    Bat2 "BAT2" "supply energy" "battery" "critical voltage" {
        cause "discharge, dead cell", effect "imminent loss of control";
        severity Fatal Fatal, class Global, Permanent;
        lost "P3D" [P3d] [Battery];
        seen "P3D" "voltage below 11.0 V" 1_000 (flags [BatteryCritical]);
        answer Vital "security objective before the controller cuts power";
        rate 60_000 Assumed "assumed", injection "capacity*=0.2";
    }
    Bat3 "BAT3" "supply energy" "battery or connector" "sudden loss" {
        cause "connector, fuse", effect "robot off";
        severity Fatal Fatal, class Global, Permanent;
        lost "P3D" [P3d] [Battery];
        seen "LAN heartbeat at the operator side" "no message for 2 s" 2_000 (flags [RobotSilent]);
        answer Vital "robot safe by itself (wheels stop); operator alarm";
        rate 400_000 Assumed "assumed (share of the 6-20 h field MTBF of Carlson & Murphy 2005); \
                              power 10 % assumed",
        injection "all off";
    }
    Pwr1 "PWR1" "supply energy" "laptop battery" "laptop goes down" {
        cause "discharge", effect "control lost; firmware watchdog stops the motors";
        severity Fatal Fatal, class Global, Permanent;
        lost "all" all [LaptopCpu];
        seen "P3D firmware" "no command for 2 s: firmware watchdog stops the robot"
             2_000 (silent "the laptop itself is down: nothing of the architecture is left to see \
                            it; the firmware stops the robot");
        answer - "firmware stop";
        rate 60_000 Assumed "assumed", injection "architecture silent";
    }
    P3d1 "P3D1" "talk to the robot" "serial/USB link" "link lost" {
        cause "connector, converter", effect "no sensor value, no command";
        severity Fatal Fatal, class Global, Permanent;
        lost "P3D and all" all [SerialLink];
        seen "P3D; firmware watchdog" "no packet for 5 cycles (0.5 s)" 500 (flags [PacketSilence]);
        answer Vital "security objective; firmware stops after 2 s";
        rate 200_000 Assumed "assumed (share of the 6-20 h field MTBF of Carlson & Murphy 2005); \
                              control system 35 % assumed",
        injection "drop all packets";
    }
    P3d2 "P3D2" "talk to the robot" "serial/USB link" "packets lost or corrupt" {
        cause "noise, load", effect "late data";
        severity Weak Weak, class Adapter, Transient;
        lost "-" [] [];
        seen "P3D" "checksum errors above 5 % in 2 s" 2_000 (flags [PacketErrors]);
        answer Minor "extend the tolerance of the watchdog", adjusts WidenTolerance;
        rate 10_000 Assumed "assumed", injection "drop with p=0.05..0.5";
    }
    P3d3 "P3D3" "talk to the robot" "micro-controller" "reset" {
        cause "brown-out", effect "pose zeroed, parameters lost";
        severity Hard Medium, class Local, Transient;
        lost "ODO" [Odo] [];
        seen "P3D; O-LOC" "sequence restart, jump of pose"
             1_000 (flags [SequenceRestart] sometimes [PoseJump]);
        answer Ambiguous "stop, re-initialise, ask the operator";
        rate 200_000 Assumed "assumed", injection "odometry reset to 0";
    }
    Rt1 "RT1" "localise" "MCL" "deadline missed again and again" {
        cause "too many particles, load of the laptop", effect "loop over 0.1 s";
        severity Medium Weak, class Adapter, Permanent;
        lost "-" [] [];
        seen "SCH" "K consecutive violations in spite of the extra time (TAROS 2010, VI.A.1)"
             300 (flags [MclLate] with Mcl);
        answer Slow "fewer particles";
        rate 20_000 Assumed "assumed; happens once in the seed run",
        injection "load: 3 ms of every 10";
    }
    Rt2 "RT2" "schedule" "any module" "one late job" {
        cause "transient load", effect "jitter";
        severity Weak Weak, class Adapter, Transient;
        lost "-" [] [];
        seen "SCH" "one violation inside the extra time" 100 (flags [OneLate]);
        answer - "tolerated",
               tolerated "one job inside its extra time is what the extra time is for \
                          (Section VI.A.1)";
        rate 500 Assumed "assumed", injection "job time += 30 ms once";
    }
    Rt3 "RT3" "schedule" "any other module" "deadline missed again and again" {
        cause "software fault, CPU throttling", effect "stale data";
        severity Hard Hard, class Local, Permanent;
        lost "that module" one [];
        seen "SCH" "K consecutive violations" 300 (flags [ModuleLate] sometimes [MclLate]);
        answer Ambiguous "another configuration without the module, else operator";
        rate 100_000 Assumed "assumed", injection "jobs of m pass their budget";
    }
    Sw1 "SW1" "compute" "any module" "crash" {
        cause "software fault", effect "its outputs stop";
        severity Hard Hard, class Local, Permanent;
        lost "that module" one [];
        seen "SCH" "no completion at all for K periods"
             300 (flags [ModuleSilent] sometimes [ModuleLate]);
        answer Ambiguous "restart once; else another configuration; else operator";
        rate 40_000 Assumed "assumed; one study finds 54 % of failures in the control system \
                             (Carlson & Murphy 2005)",
        injection "kill module";
    }
    Sw2 "SW2" "compute" "any module" "wrong value (NaN, out of interval)" {
        cause "software fault", effect "corrupt data downstream";
        severity Hard Hard, class Local, Transient;
        lost "that module" one [];
        seen "O-SEN; O-LOC; O-PF" "interval check" 100 (flags [ValueOutside]);
        answer Ambiguous "as SW1";
        rate 60_000 Assumed "assumed", injection "output=NaN or x10";
    }
    Sw3 "SW3" "compute" "laptop or real-time kernel" "hang" {
        cause "driver, kernel", effect "all silent";
        severity Fatal Fatal, class Global, Permanent;
        lost "all" all [LaptopCpu];
        seen "P3D firmware" "no command for 2 s"
             2_000 (silent "the laptop itself hangs: nothing of the architecture runs to see it; \
                            the firmware stops the robot");
        answer - "firmware stop";
        rate 150_000 Assumed "assumed", injection "architecture silent";
    }
    Loc1 "LOC1" "localise" "MCL" "filter diverged" {
        cause "symmetric corridor, people, bad start", effect "wrong pose";
        severity Hard Weak, class Local, Permanent;
        lost "MCL" [Mcl] [];
        seen "O-LOC" "pose jump, spread, odometry-MCL distance"
             3_000 (flags [PoseGrowth]
                    sometimes [PoseDistance, PoseJump, Spread, Backward] with Mcl);
        answer Mcl "operator, or odometry if the cause is known to be MCL";
        rate 12_000 Assumed "assumed", injection "replace the cloud at a wrong pose";
    }
    Loc2 "LOC2" "localise" "map" "map wrong at this place (uncharted obstacle)" {
        cause "moved furniture, closed door", effect "avoidance loops; backward motion; MCL biased";
        severity Hard Weak, class Local, Permanent;
        lost "-" [] [];
        seen "O-LOC and O-PF" "two flags, no unique diagnosis (TAROS 2010, VI.A.2)"
             8_000 (flags [PoseGrowth, Backward] with Mcl);
        answer Ambiguous "ask the operator, new path";
        rate 4_000 Assumed "assumed", injection "add an obstacle across the path";
    }
    Loc3 "LOC3" "localise" "odometry only (degraded mode)" "drift beyond the corridor width" {
        cause "time without fix", effect "collision with a wall";
        severity Hard Weak, class Local, Permanent;
        lost "-" [] [];
        seen "P3D (bumper)" "bumper in degraded mode -> hard (TAROS 2010, VI.A.4)"
             100 (flags [Bumper] without Mcl);
        answer Collision "operator, degraded teleoperation";
        rate 500 Assumed "assumed; grows with distance (odometry model)", injection "emergent";
    }
    Ppl1 "PPL1" "plan a path" "PPL" "no path" {
        cause "blocked, Lazy PRM too sparse", effect "no motion";
        severity Hard Weak, class Local, Transient;
        lost "PPL" [Ppl] [];
        seen "PPL" "planner returns failure or time-out" 5_000 (flags [PlanFailed] with Ppl);
        answer Planner "operator gives way-points";
        rate 10_000 Assumed "assumed", injection "planner fails with p";
    }
    Col1 "COL1" "avoid obstacles" "SMZ" "collision with a fixed obstacle" {
        cause "blind sector, glass, low object", effect "contact";
        severity Medium Medium, class Adapter, Transient;
        lost "-" [] [];
        seen "P3D (bumper)" "bumper closed" 100 (flags [Bumper] with Smz);
        answer Collision "stop, back off, slower; hard if avoidance is already off \
                          (TAROS 2010, VI.A.4)",
               adjusts GoCarefully;
        rate 20_000 Assumed "assumed", injection "glass wall invisible to sonar";
    }
    Hum1 "HUM1" "avoid obstacles" "people" "person steps in the way" {
        cause "environment", effect "wait or detour";
        severity Weak Weak, class Adapter, Transient;
        lost "-" [] [];
        seen "O-PF" "progress below limit for 5 s" 5_000 (flags [NoProgress]);
        answer Minor "wait, slow", adjusts GiveWay;
        rate 200 Assumed "assumed", injection "moving disc obstacles";
    }
    Com1 "COM1" "talk to the operator" "WiFi" "link lost" {
        cause "range, access point", effect "no help possible";
        severity Weak Fatal, class Adapter, Transient;
        lost "LAN CAM" [Lan, Cam] [WifiCard];
        seen "O-COM" "link flag, no heartbeat for 2 s"
             2_000 (flags [LinkDown] sometimes [LinkPoor, NoFrame, OldFrame] with Lan);
        answer Wifi "go on alone; fatal as soon as help is needed";
        rate 5_000 Assumed "assumed; limited WiFi range is a listed common cause in Carlson & \
                            Murphy 2005",
        injection "lan=off for 5..120 s or for ever";
    }
    Com2 "COM2" "talk to the operator" "WiFi" "weak signal, high delay" {
        cause "range, load", effect "slow teleoperation";
        severity Weak Medium, class Adapter, Transient;
        lost "-" [] [];
        seen "O-COM" "level or noise out of interval"
             1_000 (flags [LinkPoor] sometimes [OldFrame] with Lan);
        answer Minor "lower image rate and speed limit", adjusts FewerFrames;
        rate 1_000 Assumed "assumed", injection "delay 0.2..2 s, loss 1..30 %";
    }
    Opr1 "OPR1" "decide" "operator" "no answer" {
        cause "absent", effect "robot blocks the corridor";
        severity Hard Hard, class Local, Permanent;
        lost "-" [] [];
        seen "CS timer" "T_op = 120 s" 120_000 (flags [OperatorSilent]);
        answer Refusal "global event: safe stop and alarm";
        rate 50_000 Assumed "assumed", injection "operator silent";
    }
}
