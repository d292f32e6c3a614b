//! Runs a scene in Rapier with its defaults, and prints one line of JSON as bench/drivers/report.h describes it.

mod scene;

use std::time::Instant;

use rapier2d::prelude::*;
use scene::{Body, BodyKind, Geometry, Point, Revolute, Scene, Shape};

const TIME_STEP: f64 = 1.0 / 60.0;
/// Rapier's motors are springs on the velocity; this stiff they follow within a step.
const MOTOR_FACTOR: f32 = 1e6;

fn vector(point: &Point) -> Vector {
    Vector::new(point[0], point[1])
}

fn collider(shape: &Shape, apart: bool) -> Collider {
    let builder = match &shape.geometry {
        Geometry::Box { half, center } => ColliderBuilder::cuboid(half[0], half[1]).translation(vector(center)),
        Geometry::Circle { radius, center } => ColliderBuilder::ball(*radius).translation(vector(center)),
        Geometry::Capsule { a, b, radius } => ColliderBuilder::capsule_from_endpoints(vector(a), vector(b), *radius),
        Geometry::RoundedBox { half, rounding } => ColliderBuilder::round_cuboid(half[0], half[1], *rounding),
        Geometry::Polygon(points) => ColliderBuilder::convex_polyline(points.iter().map(vector).collect())
            .expect("the polygons of the scenes are convex"),
        Geometry::Loop(points) => {
            let count = points.len() as u32;
            let sides = (0..count).map(|side| [side, (side + 1) % count]).collect();
            ColliderBuilder::polyline(points.iter().map(vector).collect(), Some(sides))
        }
    };
    let groups = if apart {
        InteractionGroups::new(Group::GROUP_2, !Group::GROUP_2, InteractionTestMode::And)
    } else {
        InteractionGroups::all()
    };
    builder
        .density(shape.material.density)
        .friction(shape.material.friction)
        .restitution(shape.material.restitution)
        .friction_combine_rule(CoefficientCombineRule::GeometricMean)
        .restitution_combine_rule(CoefficientCombineRule::Max)
        .collision_groups(groups)
        .build()
}

fn add_body(world: &mut PhysicsWorld, body: &Body, sleep: bool) -> RigidBodyHandle {
    let kind = match body.kind {
        BodyKind::Static => RigidBodyType::Fixed,
        BodyKind::Kinematic => RigidBodyType::KinematicVelocityBased,
        BodyKind::Dynamic => RigidBodyType::Dynamic,
    };
    let builder = RigidBodyBuilder::new(kind)
        .translation(vector(&body.position))
        .rotation(body.angle)
        .linvel(vector(&body.velocity))
        .angvel(body.spin)
        .can_sleep(sleep)
        .sleeping(!body.awake);
    let handle = world.insert_body(builder);
    for shape in &body.shapes {
        world.colliders.insert_with_parent(collider(shape, body.apart), handle, &mut world.bodies);
    }
    handle
}

fn add_revolute(world: &mut PhysicsWorld, handles: &[RigidBodyHandle], joint: &Revolute) {
    let mut builder = RevoluteJointBuilder::new()
        .local_anchor1(vector(&joint.at_a))
        .local_anchor2(vector(&joint.at_b))
        .contacts_enabled(false);
    if joint.motor_torque > 0.0 {
        builder = builder.motor_velocity(joint.motor_speed, MOTOR_FACTOR).motor_max_force(joint.motor_torque);
    }
    world.impulse_joints.insert(handles[joint.a], handles[joint.b], builder, true);
}

/// Processor time of this program so far, in milliseconds.
fn cpu_ms() -> f64 {
    let mut now = libc::timespec { tv_sec: 0, tv_nsec: 0 };
    // SAFETY: the call writes to the timespec that it is given, and nothing else.
    unsafe { libc::clock_gettime(libc::CLOCK_PROCESS_CPUTIME_ID, &mut now) };
    now.tv_sec as f64 * 1e3 + now.tv_nsec as f64 * 1e-6
}

/// Bytes in use on the heap of this program, which is the C library's.
fn heap_bytes() -> usize {
    // SAFETY: the call only reads the allocator's counts.
    let facts = unsafe { libc::mallinfo2() };
    facts.uordblks + facts.hblkhd
}

/// Bytes that the world takes: as built, and at the end.
struct Heap {
    built: usize,
    stepped: usize,
}

/// What the steps took: each by the wall clock, and all together of the processor, in milliseconds.
struct Timing {
    step_ms: Vec<f64>,
    cpu_ms_sum: f64,
}

struct Arguments {
    scene_path: String,
    threads: usize,
    steps: Option<usize>,
    skip: usize,
    states: bool,
    engine: String,
}

fn parse_arguments() -> Result<Arguments, String> {
    let mut arguments =
        Arguments { scene_path: String::new(), threads: 1, steps: None, skip: 0, states: false, engine: "rapier".into() };
    let mut words = std::env::args().skip(1);
    while let Some(word) = words.next() {
        let mut value = || words.next().ok_or(format!("{word} needs a value"));
        match word.as_str() {
            "--threads" => arguments.threads = value()?.parse().map_err(|error| format!("{error}"))?,
            "--steps" => arguments.steps = Some(value()?.parse().map_err(|error| format!("{error}"))?),
            "--skip" => arguments.skip = value()?.parse().map_err(|error| format!("{error}"))?,
            "--states" => arguments.states = true,
            "--engine" => arguments.engine = value()?,
            _ => arguments.scene_path = word,
        }
    }
    if arguments.scene_path.is_empty() {
        return Err("usage: peers SCENE_FILE [--threads N] [--steps N] [--skip N] [--states] [--engine NAME]".into());
    }
    Ok(arguments)
}

#[cfg(feature = "parallel")]
fn set_threads(world: &mut PhysicsWorld, threads: usize) -> Result<(), String> {
    world.configure_thread_pool(threads).map_err(|error| error.to_string())
}

#[cfg(not(feature = "parallel"))]
fn set_threads(_: &mut PhysicsWorld, threads: usize) -> Result<(), String> {
    if threads == 1 { Ok(()) } else { Err("more than one thread needs the feature \"parallel\"".into()) }
}

/// FNV-1a over the bytes of the poses.
fn hash_of(world: &PhysicsWorld, handles: &[RigidBodyHandle]) -> u64 {
    let mut hash = 0xcbf29ce484222325u64;
    for handle in handles {
        let body = &world.bodies[*handle];
        let (at, turn) = (body.translation(), body.rotation());
        for value in [at.x, at.y, turn.re, turn.im] {
            for byte in value.to_bits().to_le_bytes() {
                hash = (hash ^ u64::from(byte)).wrapping_mul(0x100000001b3);
            }
        }
    }
    hash
}

/// x, y, angle, velocity x and y, spin of every body.
fn states_of(world: &PhysicsWorld, handles: &[RigidBodyHandle]) -> String {
    let state = |handle: &RigidBodyHandle| {
        let body = &world.bodies[*handle];
        let (at, v) = (body.translation(), body.linvel());
        format!("[{},{},{},{},{},{}]", at.x, at.y, body.rotation().angle(), v.x, v.y, body.angvel())
    };
    format!(",\"states\":[{}]", handles.iter().map(state).collect::<Vec<_>>().join(","))
}

fn print_report(
    arguments: &Arguments,
    scene: &Scene,
    world: &PhysicsWorld,
    handles: &[RigidBodyHandle],
    timing: &Timing,
    heap: &Heap,
) {
    let ms = &timing.step_ms;
    let mut sorted = ms.clone();
    sorted.sort_by(f64::total_cmp);
    let mean = ms.iter().sum::<f64>() / ms.len() as f64;
    let bodies = scene.bodies.iter().filter(|body| body.kind == BodyKind::Dynamic).count();
    let awake = world.bodies.iter().filter(|(_, body)| !body.is_fixed() && !body.is_sleeping()).count();
    let pairs = world.narrow_phase.contact_pairs().count();
    let states = if arguments.states { states_of(world, handles) } else { String::new() };
    let touching = world.narrow_phase.contact_pairs().filter(|pair| pair.has_any_active_contact()).count();
    println!(
        "{{\"engine\":\"{}\",\"version\":\"{}\",\"scene\":\"{}\",\"threads\":{},\"steps\":{},\"cpu_ms\":{:.6},\"mean_ms\":{:.6},\
         \"median_ms\":{:.6},\"min_ms\":{:.6},\"max_ms\":{:.6},\"heap_built\":{},\"heap_stepped\":{},\"awake\":{awake},\"bodies\":{bodies},\"pairs\":{pairs},\
         \"touching\":{touching},\"hash\":\"{:016x}\",\"phases_ms\":{{}}{states}}}",
        arguments.engine,
        rapier2d::VERSION,
        scene.name,
        arguments.threads,
        ms.len(),
        timing.cpu_ms_sum / ms.len() as f64,
        mean,
        sorted[ms.len() / 2],
        sorted[0],
        sorted[ms.len() - 1],
        heap.built,
        heap.stepped,
        hash_of(world, handles),
    );
}

fn run() -> Result<(), String> {
    let arguments = parse_arguments()?;
    let text = std::fs::read_to_string(&arguments.scene_path)
        .map_err(|error| format!("{}: {error}", arguments.scene_path))?;
    let scene = Scene::read(&text)?;
    let steps = arguments.steps.unwrap_or(scene.steps);
    let mut timing = Timing { step_ms: Vec::with_capacity(steps), cpu_ms_sum: 0.0 };
    let mut handles = Vec::with_capacity(scene.bodies.len());
    let heap_before = heap_bytes();
    let mut world = PhysicsWorld::new();
    set_threads(&mut world, arguments.threads)?;
    world.gravity = vector(&scene.gravity);
    world.integration_parameters.dt = TIME_STEP as f32;
    handles.extend(scene.bodies.iter().map(|body| add_body(&mut world, body, scene.sleep)));
    for joint in &scene.revolutes {
        add_revolute(&mut world, &handles, joint);
    }
    let built = heap_bytes() - heap_before;
    for step in 0..arguments.skip + steps {
        for sway in &scene.sways {
            let velocity = Vector::new(sway.velocity_before(step, TIME_STEP), 0.0);
            world.bodies[handles[sway.body]].set_linvel(velocity, true);
        }
        let cpu_start = cpu_ms();
        let start = Instant::now();
        world.step();
        if step >= arguments.skip {
            timing.step_ms.push(start.elapsed().as_secs_f64() * 1e3);
            timing.cpu_ms_sum += cpu_ms() - cpu_start;
        }
    }
    let heap = Heap { built, stepped: heap_bytes() - heap_before };
    print_report(&arguments, &scene, &world, &handles, &timing, &heap);
    Ok(())
}

fn main() {
    if let Err(message) = run() {
        eprintln!("{message}");
        std::process::exit(2);
    }
}
