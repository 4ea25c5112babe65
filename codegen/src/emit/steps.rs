//! The loop of a kernel as Rust: its statements, for one number or for lanes of numbers.
//!
//! Lanes move together: a condition holds where it holds in all of them. Only an equation is corrected in the lanes where it
//! is not solved yet, so that each lane computes the bits that it would have alone.

use coadjoint_program::Kernel;
use coadjoint_program::schedule::{Block, Kept, Kind, Part, Statement, Test, Variable};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use crate::emit::Options;
use crate::emit::program::{apart, float};

/// The functions `open` and `steps` of a kernel that has `operations` operations.
pub(crate) fn steps(kernel: &Kernel, options: &Options, operations: usize) -> TokenStream {
    let krate = &options.krate;
    let writer = Writer { kernel, options, operations };
    let body = writer.block(kernel.schedule(), false);
    let [g, mu] = [Variable::Element, Variable::Momentum].map(|variable| writer.name(variable));
    let [c, steps, driven, live] = ["c", "steps", "driven", "live"].map(|name| options.bound(name));
    let [bound, distance] =
        [Variable::ResidualBound, Variable::Distance].map(|variable| writer.name(variable));
    let roundings = float(kernel.tolerance / kernel.precision().epsilon());
    let near = float(kernel.near);
    let done = writer.name(Variable::Done);
    let [element, dim] = [kernel.element, kernel.dim].map(Literal::usize_unsuffixed);
    let state = quote!(([T; #element], [T; #dim]));
    quote! {
        /// Whether an equation is corrected again: not solved to rounding, and near the first guess.
        #[inline(always)]
        fn open<T: #krate::plumbing::Number, C: #krate::plumbing::Coefficients<T>>(
            #c: C, #bound: T, #distance: T,
        ) -> T::Mask {
            !T::simd_le(#bound, #c.of(#roundings) * #c.epsilon()) & T::simd_le(#distance, #c.of(#near))
        }

        /// Makes up to `steps` steps from a state (g, μ), in lanes as long as all of them are right; the state after them.
        ///
        /// A step solves its equation by corrections: p from the first guess on, x, a bound on the residual, and the
        /// distance from the guess, both relative to the largest coordinate of μ. The state is checked after a block of
        /// steps, and where it is broken it goes back to the start of the block.
        #[inline(always)]
        fn steps<T: #krate::plumbing::Number, C: #krate::plumbing::Coefficients<T>>(
            #c: C,
            (mut #g, mut #mu): #state,
            #steps: u64,
        ) -> (#krate::plumbing::Driven<[T; #dim], T>, #state) {
            use #krate::plumbing::{Driven, choose, choose_all, is_one};
            let mut #driven = Driven::none(#c.of(0.0));
            let mut #live = true;
            #body
            #driven.steps = #done;
            (#driven, (#g, #mu))
        }
    }
}

struct Writer<'a> {
    kernel: &'a Kernel,
    options: &'a Options,
    operations: usize,
}

impl Writer<'_> {
    fn name(&self, variable: Variable) -> Ident {
        self.options.bound(variable.name())
    }

    fn block(&self, block: &Block, masked: bool) -> TokenStream {
        // The results of a program of a masked block that are the block's own are declared by the call.
        let declared = |variable: Variable| {
            let by = |statement: &Statement| match statement {
                Statement::Call(part) => part.variables(self.kernel).1.contains(&variable),
                _ => false,
            };
            masked && block.body.iter().any(by)
        };
        let variables = block.variables.iter().filter(|&&(variable, _)| !declared(variable));
        let variables = variables.map(|&(variable, initial)| {
            let name = self.name(variable);
            let initial = initial.unwrap_or(0);
            let (number, c) = (float(f64::from(initial)), self.options.bound("c"));
            match variable.kind(self.kernel) {
                Kind::Array(len) => {
                    let len = Literal::usize_unsuffixed(len);
                    quote!(let mut #name = [#c.of(#number); #len];)
                }
                Kind::Number => quote!(let mut #name = #c.of(#number);),
                Kind::Count => {
                    let initial = Literal::u32_unsuffixed(initial);
                    quote!(let mut #name: u64 = #initial;)
                }
            }
        });
        let body = block.body.iter().map(|statement| self.statement(statement, block, masked));
        quote!(#(#variables)* #(#body)*)
    }

    fn statement(&self, statement: &Statement, within: &Block, masked: bool) -> TokenStream {
        let [driven, live] = ["driven", "live"].map(|name| self.options.bound(name));
        let [g, mu, g_start, mu_start] =
            ["g", "mu", "g_start", "mu_start"].map(|name| self.options.bound(name));
        let [x, bound, distance, moved, done, count, tried] = [
            Variable::Increment,
            Variable::ResidualBound,
            Variable::Distance,
            Variable::Moved,
            Variable::Done,
            Variable::Count,
            Variable::Tried,
        ]
        .map(|variable| self.name(variable));
        match statement {
            Statement::Clock => TokenStream::new(),
            Statement::Call(part) => self.call(*part, within, masked),
            Statement::Lengthen => {
                let sum = self.chosen(Variable::Distance, masked, &quote!(#distance + #moved));
                quote!(#distance = #sum;)
            }
            Statement::Next(variable) => {
                let name = self.name(*variable);
                quote!(#name += 1;)
            }
            Statement::Keep(_) => quote!(let (#g_start, #mu_start) = (#g, #mu);),
            Statement::Restore(Kept::Step) => quote!((#g, #mu) = (#g_start, #mu_start);),
            Statement::Restore(Kept::Block) => quote! {
                (#g, #mu) = (#g_start, #mu_start);
                #done -= #count;
            },
            Statement::Note => quote!(#driven.note(#tried, #bound);),
            Statement::RefuseStep => quote! {
                #driven.refused = ::core::option::Option::Some((#x, #distance));
                #live = false;
            },
            Statement::RefuseState => quote! {
                #driven.refused = ::core::option::Option::None;
                #live = false;
            },
            Statement::While(condition, block) => {
                self.branch(&quote!(while), condition, block, masked)
            }
            Statement::If(condition, block) => self.branch(&quote!(if), condition, block, masked),
        }
    }

    /// A loop or a branch; its block has a mask of lanes where the condition is one of lanes.
    fn branch(
        &self,
        word: &TokenStream,
        condition: &[(bool, Test)],
        block: &Block,
        masked: bool,
    ) -> TokenStream {
        let tests = condition.iter().map(|&(holds, test)| self.test(holds, test));
        if !condition.contains(&(true, Test::Open)) {
            let body = self.block(block, masked);
            return quote!(#word #(#tests)&&* { #body });
        }
        let [lanes, c] = ["lanes", "c"].map(|name| self.options.bound(name));
        let [bound, distance] =
            [Variable::ResidualBound, Variable::Distance].map(|variable| self.name(variable));
        let within = masked.then(|| quote!(#lanes &));
        let body = self.block(block, true);
        quote! {
            let mut #lanes = #within open(#c, #bound, #distance);
            #word #(#tests)&&* {
                #body
                #lanes = #lanes & open(#c, #bound, #distance);
            }
        }
    }

    fn test(&self, holds: bool, test: Test) -> TokenStream {
        let not = (!holds).then(|| quote!(!));
        let [live, steps, lanes, c] =
            ["live", "steps", "lanes", "c"].map(|name| self.options.bound(name));
        match test {
            Test::Live => quote!(#not #live),
            Test::Remaining => {
                let done = self.name(Variable::Done);
                match holds {
                    true => quote!(#done < #steps),
                    false => quote!(#done >= #steps),
                }
            }
            Test::Below(count, most) => {
                let (count, most) = (self.name(count), Literal::u32_unsuffixed(most));
                match holds {
                    true => quote!(#count < #most),
                    false => quote!(#count >= #most),
                }
            }
            Test::Open => quote!(#not T::any(#lanes)),
            Test::Right => {
                let right = self.name(Variable::Right);
                quote!(#not is_one(#c, #right))
            }
        }
    }

    fn call(&self, part: Part, within: &Block, masked: bool) -> TokenStream {
        let krate = &self.options.krate;
        let function = format_ident!("{}", Part::ALL[part as usize].1);
        let c = self.options.bound("c");
        let (inputs, outputs) = part.variables(self.kernel);
        let inputs = inputs.iter().map(|&variable| {
            let name = self.name(variable);
            match variable.kind(self.kernel) {
                Kind::Array(_) => quote!(&#name),
                Kind::Number => quote!(#name),
                Kind::Count => quote!(#c.of(#name as f64)),
            }
        });
        let call = apart(krate, &quote!(#function(#c, #(#inputs),*)), self.operations);
        let names = outputs.iter().map(|&variable| self.name(variable));
        let names: Vec<_> = names.collect();
        let tuple = |names: &[Ident]| match names {
            [one] => quote!(#one),
            several => quote!((#(#several),*)),
        };
        if !masked {
            let names = tuple(&names);
            return quote!(#names = #call;);
        }
        // A value of a variable of this block alone nobody reads in other lanes.
        let next = |(&variable, name): (&Variable, &Ident)| match within.owns(variable) {
            true => name.clone(),
            false => self.options.bound(&format!("{}_next", variable.name())),
        };
        let nexts: Vec<Ident> = outputs.iter().zip(&names).map(next).collect();
        let moves = outputs.iter().zip(names.iter().zip(&nexts)).filter(|(_, (a, b))| a != b);
        let moves = moves.map(|(&variable, (name, next))| {
            let value = self.chosen(variable, masked, &quote!(#next));
            quote!(#name = #value;)
        });
        let nexts = tuple(&nexts);
        quote!(let #nexts = #call; #(#moves)*)
    }

    /// A new value in the lanes of a mask, in others that of the variable.
    fn chosen(&self, variable: Variable, masked: bool, new: &TokenStream) -> TokenStream {
        if !masked {
            return new.clone();
        }
        let (name, lanes) = (self.name(variable), self.options.bound("lanes"));
        match variable.kind(self.kernel) {
            Kind::Array(_) => quote!(choose_all(#lanes, #new, #name)),
            _ => quote!(choose(#lanes, #new, #name)),
        }
    }
}
