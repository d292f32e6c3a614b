//! Rapier behind C functions, for bench/accuracy/rapier_engine.cpp, which says what they mean.

use rapier2d::prelude::*;

pub struct RapierWorld {
    world: PhysicsWorld,
    handles: Vec<RigidBodyHandle>,
}

#[repr(C)]
#[derive(Clone, Copy)]
pub struct RapierState {
    x: f32,
    y: f32,
    angle: f32,
    vx: f32,
    vy: f32,
    w: f32,
}

#[repr(C)]
pub struct RapierTouch {
    a: u32,
    b: u32,
    nx: f32,
    ny: f32,
    normal_impulse: f32,
    tangent_impulse: f32,
}

fn rule_of(number: u32) -> CoefficientCombineRule {
    match number {
        0 => CoefficientCombineRule::GeometricMean,
        1 => CoefficientCombineRule::Max,
        2 => CoefficientCombineRule::Min,
        _ => CoefficientCombineRule::Average,
    }
}

#[unsafe(no_mangle)]
pub extern "C" fn rapier_create(gx: f32, gy: f32, time_step: f32, iterations: u32) -> *mut RapierWorld {
    let mut world = PhysicsWorld::new();
    world.gravity = Vector::new(gx, gy);
    world.integration_parameters.dt = time_step;
    world.integration_parameters.num_solver_iterations = iterations as usize;
    Box::into_raw(Box::new(RapierWorld { world, handles: Vec::new() }))
}

/// # Safety
/// `world` comes from rapier_create and is not used any more.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rapier_destroy(world: *mut RapierWorld) {
    drop(unsafe { Box::from_raw(world) });
}

#[unsafe(no_mangle)]
pub extern "C" fn rapier_add_body(this: &mut RapierWorld, kind: u32, state: RapierState, continuous: bool, sleep: bool) {
    let kind = match kind {
        0 => RigidBodyType::Fixed,
        1 => RigidBodyType::KinematicVelocityBased,
        _ => RigidBodyType::Dynamic,
    };
    let builder = RigidBodyBuilder::new(kind)
        .translation(Vector::new(state.x, state.y))
        .rotation(state.angle)
        .linvel(Vector::new(state.vx, state.vy))
        .angvel(state.w)
        .ccd_enabled(continuous)
        .can_sleep(sleep);
    let handle = this.world.insert_body(builder);
    this.handles.push(handle);
}

/// # Safety
/// `points` holds `count` pairs of numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rapier_add_shape(
    this: &mut RapierWorld,
    points: *const f32,
    count: u32,
    radius: f32,
    density: f32,
    friction: f32,
    restitution: f32,
    friction_rule: u32,
    restitution_rule: u32,
) {
    let numbers = unsafe { std::slice::from_raw_parts(points, 2 * count as usize) };
    let builder = if count == 1 && radius > 0.0 {
        ColliderBuilder::ball(radius).translation(Vector::new(numbers[0], numbers[1]))
    } else if count == 1 {
        ColliderBuilder::cuboid(numbers[0], numbers[1])
    } else {
        ColliderBuilder::convex_polyline(numbers.chunks(2).map(|p| Vector::new(p[0], p[1])).collect())
            .expect("the polygons of the cases are convex")
    };
    let collider = builder
        .density(density)
        .friction(friction)
        .restitution(restitution)
        .friction_combine_rule(rule_of(friction_rule))
        .restitution_combine_rule(rule_of(restitution_rule))
        .build();
    let body = *this.handles.last().expect("a body comes before its shapes");
    this.world.colliders.insert_with_parent(collider, body, &mut this.world.bodies);
}

#[unsafe(no_mangle)]
pub extern "C" fn rapier_set_mass(this: &mut RapierWorld, mass: f32, inertia: f32) {
    let handle = *this.handles.last().expect("a body comes before its mass");
    let colliders: Vec<_> = this.world.bodies[handle].colliders().to_vec();
    for collider in colliders {
        this.world.colliders[collider].set_mass_properties(MassProperties::new(Vector::ZERO, mass, inertia));
    }
}

#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)]
pub extern "C" fn rapier_add_hinge(
    this: &mut RapierWorld,
    a: u32,
    b: u32,
    ax: f32,
    ay: f32,
    bx: f32,
    by: f32,
    collide: bool,
) {
    let joint = RevoluteJointBuilder::new()
        .local_anchor1(Vector::new(ax, ay))
        .local_anchor2(Vector::new(bx, by))
        .contacts_enabled(collide);
    this.world.impulse_joints.insert(this.handles[a as usize], this.handles[b as usize], joint, true);
}

#[unsafe(no_mangle)]
pub extern "C" fn rapier_step(this: &mut RapierWorld) {
    this.world.step();
}

#[unsafe(no_mangle)]
pub extern "C" fn rapier_state(this: &RapierWorld, number: u32) -> RapierState {
    let body = &this.world.bodies[this.handles[number as usize]];
    let (at, v) = (body.translation(), body.linvel());
    RapierState { x: at.x, y: at.y, angle: body.rotation().angle(), vx: v.x, vy: v.y, w: body.angvel() }
}

#[unsafe(no_mangle)]
pub extern "C" fn rapier_set_velocity(this: &mut RapierWorld, number: u32, vx: f32, vy: f32, w: f32) {
    let body = &mut this.world.bodies[this.handles[number as usize]];
    body.set_linvel(Vector::new(vx, vy), true);
    body.set_angvel(w, true);
}

/// # Safety
/// `out` has room for `most` entries.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rapier_touches(this: &RapierWorld, out: *mut RapierTouch, most: u32) -> u32 {
    let number_of = |collider: ColliderHandle| {
        let parent = this.world.colliders[collider].parent();
        this.handles.iter().position(|handle| Some(*handle) == parent).unwrap_or(usize::MAX) as u32
    };
    let mut count = 0;
    for pair in this.world.narrow_phase.contact_pairs() {
        for manifold in pair.manifolds() {
            for point in &manifold.points {
                if count < most {
                    let touch = RapierTouch {
                        a: number_of(pair.collider1),
                        b: number_of(pair.collider2),
                        nx: manifold.data.normal.x,
                        ny: manifold.data.normal.y,
                        normal_impulse: point.data.impulse,
                        tangent_impulse: point.data.tangent_impulse.x,
                    };
                    unsafe { out.add(count as usize).write(touch) };
                }
                count += 1;
            }
        }
    }
    count
}

#[unsafe(no_mangle)]
pub extern "C" fn rapier_version() -> *const std::ffi::c_char {
    static VERSION: std::sync::OnceLock<std::ffi::CString> = std::sync::OnceLock::new();
    VERSION.get_or_init(|| std::ffi::CString::new(rapier2d::VERSION).expect("a version holds no zero")).as_ptr()
}
