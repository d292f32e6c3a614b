//! A scene of the benchmark as its file describes it (bench/scenes.py says how).

use std::str::FromStr;

pub type Point = [f32; 2];

#[derive(Clone, Copy)]
pub struct Material {
    pub density: f32,
    pub friction: f32,
    pub restitution: f32,
}

pub enum Geometry {
    Box { half: Point, center: Point },
    Circle { radius: f32, center: Point },
    Capsule { a: Point, b: Point, radius: f32 },
    RoundedBox { half: Point, rounding: f32 },
    Polygon(Vec<Point>),
    Loop(Vec<Point>),
}

pub struct Shape {
    pub geometry: Geometry,
    pub material: Material,
}

#[derive(Clone, Copy, PartialEq)]
pub enum BodyKind {
    Static,
    Kinematic,
    Dynamic,
}

pub struct Body {
    pub kind: BodyKind,
    pub position: Point,
    pub angle: f32,
    pub velocity: Point,
    pub spin: f32,
    pub awake: bool,
    pub apart: bool,
    pub shapes: Vec<Shape>,
}

pub struct Revolute {
    pub a: usize,
    pub b: usize,
    pub at_a: Point,
    pub at_b: Point,
    pub motor_speed: f32,
    pub motor_torque: f32,
}

pub struct Sway {
    pub body: usize,
    amplitude: f64,
    rate: f64,
}

impl Sway {
    /// Before step k: what leads from amplitude · sin(rate · (k − 1) · dt) to amplitude · sin(rate · k · dt).
    pub fn velocity_before(&self, step: usize, time_step: f64) -> f32 {
        let x = |step: f64| self.amplitude * (self.rate * step * time_step).sin();
        ((x(step as f64) - x(step as f64 - 1.0)) / time_step) as f32
    }
}

#[derive(Default)]
pub struct Scene {
    pub name: String,
    pub steps: usize,
    pub gravity: Point,
    pub sleep: bool,
    pub bodies: Vec<Body>,
    pub revolutes: Vec<Revolute>,
    pub sways: Vec<Sway>,
}

/// The words of one line, taken from left to right.
struct Words<'a> {
    words: std::str::SplitWhitespace<'a>,
    line: &'a str,
}

impl Words<'_> {
    fn next<T: FromStr>(&mut self) -> Result<T, String> {
        let word = self.words.next().ok_or_else(|| format!("cut short: {}", self.line))?;
        word.parse().map_err(|_| format!("not a value: {word} in {}", self.line))
    }
    fn flag(&mut self) -> Result<bool, String> {
        Ok(self.next::<u8>()? != 0)
    }
    fn point(&mut self) -> Result<Point, String> {
        Ok([self.next()?, self.next()?])
    }
    fn material(&mut self) -> Result<Material, String> {
        Ok(Material { density: self.next()?, friction: self.next()?, restitution: self.next()? })
    }
    fn points(&mut self) -> Result<Vec<Point>, String> {
        let values: Result<Vec<f32>, _> = self.words.by_ref().map(str::parse).collect();
        let values = values.map_err(|error| format!("{error} in {}", self.line))?;
        Ok(values.chunks_exact(2).map(|pair| [pair[0], pair[1]]).collect())
    }
}

impl Scene {
    pub fn read(text: &str) -> Result<Scene, String> {
        let mut scene = Scene::default();
        for line in text.lines() {
            let mut words = Words { words: line.split_whitespace(), line };
            let word: String = words.next()?;
            match word.as_str() {
                "scene" => {
                    scene.name = words.next()?;
                    scene.steps = words.next()?;
                    scene.gravity = words.point()?;
                    scene.sleep = words.flag()?;
                }
                "needs" => {}
                "body" => scene.bodies.push(read_body(&mut words)?),
                "revolute" => scene.revolutes.push(Revolute {
                    a: words.next()?,
                    b: words.next()?,
                    at_a: words.point()?,
                    at_b: words.point()?,
                    motor_speed: words.next()?,
                    motor_torque: words.next()?,
                }),
                "sway" => scene.sways.push(Sway { body: words.next()?, amplitude: words.next()?, rate: words.next()? }),
                _ => {
                    let body = scene.bodies.last_mut().ok_or("a shape before any body")?;
                    if word == "apart" {
                        body.apart = true;
                    } else {
                        body.shapes.push(read_shape(&word, &mut words)?);
                    }
                }
            }
        }
        Ok(scene)
    }
}

fn read_body(words: &mut Words) -> Result<Body, String> {
    let kind = match words.next::<String>()?.as_str() {
        "static" => BodyKind::Static,
        "kinematic" => BodyKind::Kinematic,
        "dynamic" => BodyKind::Dynamic,
        other => return Err(format!("unknown kind of body: {other}")),
    };
    Ok(Body {
        kind,
        position: words.point()?,
        angle: words.next()?,
        velocity: words.point()?,
        spin: words.next()?,
        awake: words.flag()?,
        apart: false,
        shapes: Vec::new(),
    })
}

fn read_shape(word: &str, words: &mut Words) -> Result<Shape, String> {
    let (geometry, material) = match word {
        "box" => (Geometry::Box { half: words.point()?, center: words.point()? }, words.material()?),
        "circle" => (Geometry::Circle { radius: words.next()?, center: words.point()? }, words.material()?),
        "capsule" => {
            (Geometry::Capsule { a: words.point()?, b: words.point()?, radius: words.next()? }, words.material()?)
        }
        "rounded_box" => (Geometry::RoundedBox { half: words.point()?, rounding: words.next()? }, words.material()?),
        "polygon" => {
            let material = words.material()?;
            (Geometry::Polygon(words.points()?), material)
        }
        "loop" => {
            let material = Material { density: 0.0, friction: words.next()?, restitution: 0.0 };
            (Geometry::Loop(words.points()?), material)
        }
        other => return Err(format!("unknown word: {other}")),
    };
    Ok(Shape { geometry, material })
}
